"""One calibration record."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from functools import cached_property
from typing import Any

from tumble.calibrations.core.provenance import LimitCheck, Provenance
from tumble.calibrations.core.verdict import Model, Verdict
from tumble.calibrations.records.old_formats import METHODS_SINCE, model_of, models_of
from tumble.calibrations.records.parameter import RecordedParameter, parameters_from_json

FORMAT_VERSION = 5
"""Of the records that this program writes: what a record holds and how its hash is taken.

Records of every format are read, see `old_formats`.
"""


@dataclass(frozen=True, kw_only=True)
class Link:
    """The place of a record in the chain of its writer, see `chain`."""

    writer: str
    """Sixteen hexadecimal digits: one user of one copy of a store."""
    sequence: int
    """1 for the writer's first record."""
    previous_sha256: str
    """`content_sha256` of the writer's record before; empty for the first."""


@dataclass(frozen=True, kw_only=True)
class Record:
    """A result as it was recorded. It never changes; an analysis done again is a record of its own."""

    id: str
    """Day and time of recording in UTC and six hexadecimal digits: `20261122-141503-1a2b3c`. Sorts by time."""
    format_version: int
    method: str
    """Name of the method, as in the result formats."""
    method_version: int
    revision: int
    """1 for the first analysis of a raw file."""
    supersedes: str | None
    """Id of the record that this one takes the place of."""
    created_at: datetime
    """When the record was made, UTC."""
    link: Link | None
    """None up to format 3, which had no chains."""
    verdict: Verdict
    """How the unit stands against the limits of its programme."""
    limits: tuple[LimitCheck, ...]
    provenance: Provenance
    models_json: Mapping[str, Sequence[Mapping[str, Any]]] | None
    """Parameters by model, as JSON; None up to format 3, where they stand in the result alone."""
    result: Mapping[str, Any]
    """The whole result in the format of its method."""
    content_sha256: str
    """Of everything above, see `export.document`."""

    @property
    def complete(self) -> bool:
        """False where the raw file was cut off."""
        return bool(self.result.get("complete", True))

    @property
    def parameters(self) -> Mapping[str, RecordedParameter]:
        """The parameters of the declared model by name."""
        return self.models["declared"]

    @property
    def model(self) -> Model:
        """The model whose values are to be used: the augmented one where the loop found something."""
        return self.verdict.judged if self.format_version >= METHODS_SINCE else model_of(self.result)

    @cached_property
    def values(self) -> Mapping[str, RecordedParameter]:
        """The values to use, by name: what the loop withholds has none."""
        models = self.models
        augmented = models.get("augmented", {})
        return augmented if self.model is Model.AUGMENTED else _without_withheld(models["declared"], augmented)

    @cached_property
    def models(self) -> Mapping[str, Mapping[str, RecordedParameter]]:
        """The parameters of the model `declared` and, where the loop was closed, of `augmented`, by name."""
        stored = models_of(self.result) if self.models_json is None else self.models_json
        return {str(model): parameters_from_json(stored[model]) for model in Model if model in stored}


def _without_withheld(
    declared: Mapping[str, RecordedParameter], augmented: Mapping[str, RecordedParameter]
) -> dict[str, RecordedParameter]:
    """The parameters of the declared model; those to which the augmented one gives no value have none, and why."""
    return {
        name: augmented[name] if name in augmented and augmented[name].value is None else parameter
        for name, parameter in declared.items()
    }
