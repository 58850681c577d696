"""What is to be recorded: a result of any method, as data."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from tumble.calibrations.core.provenance import LimitCheck
from tumble.calibrations.core.verdict import Model, Verdict
from tumble.calibrations.records.canonical import plain
from tumble.calibrations.records.parameter import named

NOT_JUDGED = Verdict(judged=Model.DECLARED, parameters=())


@dataclass(frozen=True, kw_only=True)
class Entry:
    """A result with what the store has to know of it."""

    method: str
    """Name of the method, as in the result formats."""
    method_version: int
    result: Mapping[str, Any]
    """The whole result, as JSON has it."""
    parameters: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    """Those of the declared model by name: `value`, `unit`, `standard_uncertainty` and so on, as results have them."""
    augmented: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    """Those of the augmented model; empty where no loop was closed."""
    limits: tuple[LimitCheck, ...] = ()
    verdict: Verdict = NOT_JUDGED
    """Its `judged` is the model whose values are to be used."""

    @property
    def models(self) -> dict[str, list[dict[str, Any]]]:
        """Parameters by model, as records hold them: in lists, since the keys of a record are sorted."""
        models = {"declared": named(self.parameters)}
        augmented = {"augmented": named(self.augmented)} if self.augmented else {}
        return {model: [plain(each) for each in listed] for model, listed in (models | augmented).items()}


def loop_entry(method: str, version: int, result: Mapping[str, Any]) -> Entry:
    """A closed loop (`tumble.loop/1`): to be used is what it gives with whatever was found, named or not."""
    found = result["effects"] or result.get("unexplained")
    return Entry(
        method=method,
        method_version=version,
        result=result,
        parameters=result["declared"]["parameters"],
        augmented=result["augmented"]["parameters"],
        verdict=Verdict(judged=Model.AUGMENTED if found else Model.DECLARED, parameters=()),
    )
