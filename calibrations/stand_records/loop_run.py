"""What a run of a method with a loop of its own says of its stand, as far as that is the same for every method."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

from tumble.calibrations.core.sentences import series
from tumble.calibrations.stand_records.contradicting import contradictions
from tumble.calibrations.stand_records.corrections import Corrections
from tumble.calibrations.stand_records.record import StandRecord, Validity
from tumble.calibrations.stand_records.terms import Term
from tumble.calibrations.tracing.closed import ClosedLoop
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class LoopRun(ABC):
    """A table with the loop closed on it, as far as its stand is concerned. Fits `tumble.app.job_part.StandRun`."""

    lasting: ClassVar[Sequence[str]]
    """Effects that stay with a stand."""

    loop: ClosedLoop[Any, Any, Any]
    highest_order: int = 0
    """An error of an angle of any shape is not fitted."""

    @property
    @abstractmethod
    def terms(self) -> tuple[Term, ...]:
        """Effects of the stand that the run tells apart."""

    @abstractmethod
    def estimate(self, terms: Sequence[Term]) -> Corrections:
        """What the run says of those of these terms that it tells, fitted together with what else was found."""

    @abstractmethod
    def validity(self, measured_at: str) -> Validity:
        """Over what it was measured."""

    @property
    def objections(self) -> tuple[str, ...]:
        """Why nothing may be learned from the run, as parts of a sentence."""
        reasons = {
            Message("it was cut off"): not self.loop.declared_fit.observations.complete,
            Message("the table is in doubt"): bool(self.loop.doubts),
            Message("part of what it leaves is unexplained"): self.loop.unexplained is not None,
        }
        return tuple(reason for reason, holds in reasons.items() if holds)

    @property
    def doubts(self) -> tuple[str, ...]:
        """Of what the run does not tell whether it is the stand's."""
        return tuple(
            Message(
                "in this run alone {effect} is not distinguishable from {others}: by itself it says nothing of it",
                effect=effect.name,
                others=series(effect.also_possible, "or"),
            )
            for effect in self.loop.effects
            if effect.also_possible and set(self.lasting) & {effect.name, *effect.also_possible}
        )

    def contradictions(self, record: StandRecord) -> tuple[str, ...]:
        """Where it contradicts the stand record that was applied to it, in sentences."""
        return tuple(contradictions(self, record))
