"""One calibration record."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Any

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck, Provenance
from tumble.calibrations.core.verdict import Judgement, Model, Outcome, Verdict, verdict_from_json
from tumble.calibrations.methods.dividing_head.model import PARAMETERS
from tumble.calibrations.methods.dividing_head.usable import without_withheld

FORMAT_VERSION = 3
"""Of the records that this program writes: what a record holds and how its hash is taken.

1 had no closed loop. Up to 2 the verdict was a word, on the declared model's values alone. Records of every format are
read.
"""
JUDGED_SINCE = 3
"""The format from which on a record holds a verdict with its reasons."""
OLD_WORDS = {Outcome.PASS: "inside", Outcome.FAIL: "outside", Outcome.NO_LIMITS: "not judged"}
"""How older records spell what they decided."""


def old_verdict(limits: Sequence[LimitCheck]) -> Verdict:
    """What a record decided before there were reasons: the declared model's value, whatever it rested on."""
    return Verdict(
        judged=Model.DECLARED,
        parameters=tuple(
            Judgement(
                name=check.name,
                outcome=Outcome.PASS if check.inside else Outcome.FAIL,
                reason="judged by an earlier version, by the value of the declared model alone",
                remedy="analyse it again",
            )
            for check in limits
        ),
    )


@dataclass(frozen=True, kw_only=True)
class Record:
    """A calibration as it was recorded. It never changes; an analysis done again is a record of its own."""

    id: str
    """Day and time of recording in UTC and six hexadecimal digits: `20261122-141503-1a2b3c`. Sorts by time."""
    format_version: int
    revision: int
    """1 for the first analysis of a raw file."""
    supersedes: str | None
    """Id of the record that this one takes the place of."""
    created_at: datetime
    """When the record was made, UTC."""
    limits: tuple[LimitCheck, ...]
    provenance: Provenance
    result: Mapping[str, Any]
    """The calibration as `tumble.fit/1`, with the closed loop (`tumble.loop/1`) under `loop` where it was closed, and
    the verdict under `verdict`."""
    content_sha256: str
    """Of everything above, see `export.document`."""

    @property
    def complete(self) -> bool:
        """False where the raw file was cut off."""
        return bool(self.result["complete"])

    @property
    def verdict(self) -> Verdict:
        """How the unit stands against the limits of its programme."""
        stored = self.result.get("verdict")
        return verdict_from_json(stored) if stored else old_verdict(self.limits)

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """The parameters of the declared model by name, as the calibration had them."""
        return self.models["declared"]

    @property
    def model(self) -> Model:
        """The model whose values are to be used: the augmented one where the loop found something."""
        loop = self.result.get("loop", {})
        return Model.AUGMENTED if loop.get("effects") or loop.get("unexplained") else Model.DECLARED

    @property
    def values(self) -> Mapping[str, Parameter]:
        """The values to use, by name: what the loop withholds has none."""
        models = self.models
        if self.model is Model.AUGMENTED:
            return models["augmented"]
        return without_withheld(models["declared"], models.get("augmented", {}))

    @property
    def models(self) -> Mapping[str, Mapping[str, Parameter]]:
        """The parameters of every model in the record, see `models_from_json`."""
        return models_from_json(self.result)


def models_from_json(result: Mapping[str, Any]) -> dict[str, Mapping[str, Parameter]]:
    """Parameters of the model `declared` and, where the loop was closed, of the model `augmented`, by name.

    Where a result says of which `model` its parameters are, the declared ones stand in its loop.
    """
    loop = result.get("loop")
    declared = loop["declared"] if loop and "model" in result else result
    models: dict[str, Mapping[str, Parameter]] = {"declared": parameters_from_json(declared)}
    return models | ({"augmented": parameters_from_json(loop["augmented"])} if loop else {})


def parameters_from_json(result: Mapping[str, Any]) -> dict[str, Parameter]:
    """Parameters of a `tumble.fit/1` document in their usual order; the inverse of `Parameter.as_json`."""
    stored = result["parameters"]
    order = sorted(stored, key=lambda name: PARAMETERS.index(name) if name in PARAMETERS else len(PARAMETERS))
    return {name: _parameter(name, stored[name]) for name in order}


def _parameter(name: str, content: Mapping[str, Any]) -> Parameter:
    value, interval = content["value"], content.get("interval_95")
    return Parameter(
        name=name,
        unit=content["unit"],
        value=value,
        standard_uncertainty=content["standard_uncertainty"],
        type_a=content.get("type_a"),
        # JSON has no infinity: a value without degrees of freedom has infinitely many.
        degrees_of_freedom=None if value is None else content.get("degrees_of_freedom", float("inf")),
        interval_95=(interval[0], interval[1]) if interval else None,
        reason=content.get("reason", ""),
        given_alpha0_deg=content.get("given", {}).get("alpha0"),
        rests_on=content.get("rests_on", ""),
        remark=content.get("remark", ""),
        settled_by=tuple(content.get("settled_by", ())),
    )
