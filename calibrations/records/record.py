"""One calibration record."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from enum import StrEnum
from typing import Any

from calibrations.model import PARAMETERS
from calibrations.provenance import LimitCheck, Provenance
from calibrations.result import Parameter

FORMAT_VERSION = 2
"""Of the records that this program writes: what a record holds and how its hash is taken.

1 had no closed loop. Records of every format are read.
"""


class Verdict(StrEnum):
    """How a calibration stands against the limits of its programme."""

    INSIDE = "inside"
    OUTSIDE = "outside"
    NOT_JUDGED = "not judged"
    """The programme states no limits."""


def verdict_of(limits: Sequence[LimitCheck]) -> Verdict:
    """Inside if every parameter with limits is."""
    if not limits:
        return Verdict.NOT_JUDGED
    return Verdict.INSIDE if all(check.inside for check in limits) else Verdict.OUTSIDE


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
    verdict: Verdict
    limits: tuple[LimitCheck, ...]
    provenance: Provenance
    result: Mapping[str, Any]
    """The calibration as `tumble.fit/1`, with the closed loop (`tumble.loop/1`) under `loop` where it was closed."""
    content_sha256: str
    """Of everything above, see `export.document`."""

    @property
    def complete(self) -> bool:
        """False where the raw file was cut off."""
        return bool(self.result["complete"])

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """The parameters of the declared model by name, as the calibration had them."""
        return parameters_from_json(self.result)

    @property
    def models(self) -> Mapping[str, Mapping[str, Parameter]]:
        """The parameters of every model in the record, see `models_from_json`."""
        return models_from_json(self.result)


def models_from_json(result: Mapping[str, Any]) -> dict[str, Mapping[str, Parameter]]:
    """Parameters of the model `declared` and, where the loop was closed, of the model `augmented`, by name."""
    models: dict[str, Mapping[str, Parameter]] = {"declared": parameters_from_json(result)}
    return models | ({"augmented": parameters_from_json(result["loop"]["augmented"])} if "loop" in result else {})


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
