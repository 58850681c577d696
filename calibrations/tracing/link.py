"""A link of the chain from a residual to a name: one experiment, and what it decided."""

from dataclasses import dataclass
from typing import Any, Generic

from tumble.calibrations.core.sentences import deviations, series
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.stage import L, Stage
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class Link(Generic[L]):
    """One experiment, and what it decided."""

    experiment: Experiment
    recording: str
    stand_time_s: float
    """By the clock of the stand, any wait included."""
    before: Stage[L]
    after: Stage[L]

    @property
    def did(self) -> str:
        """What was run, and why."""
        return Message(
            "ran {programme} to tell {name} from {others}",
            programme=self.experiment.programme,
            name=self._name,
            others=series(self._others),
        )

    @property
    def separated(self) -> tuple[str, ...]:
        """The names that it distinguished, the ones that are left first; none where it failed to.

        Those that stand in different explanations afterwards are distinguished too: each of them is there.
        """
        remaining = tuple(name for name in self.rivals_before if name in self.rivals_after)
        gone = tuple(name for name in self.rivals_before if name not in remaining)
        return (*remaining, *gone) if remaining and (gone or self.each_is_there) else ()

    @property
    def each_is_there(self) -> bool:
        """Whether what could have been either turned out to be several causes."""
        left = [set(names).intersection(self.rivals_before) for names in self.after.explanations]
        return sum(map(bool, left)) > 1 and max(map(len, left)) == 1

    @property
    def confirming(self) -> bool:
        """Whether it was run though nothing had a rival, since that was barely so."""
        return not any(self._name in names for names in self.before.disputed)

    @property
    def confirmed(self) -> bool:
        """Whether that left what had been found."""
        return self.confirming and any(self._name == names[0] for names in self.after.explanations)

    @property
    def futile(self) -> bool:
        """Whether it separated nothing, though it was to do so by itself."""
        return not (self.separated or self.experiment.together or self.experiment.runs > 1 or self.confirming)

    @property
    def planned(self) -> int:
        """Of how many runs it was to be the first."""
        return self.experiment.runs + len(self.experiment.together)

    @property
    def programmes(self) -> tuple[str, ...]:
        """Of all these runs."""
        return (self.experiment.programme, *self.experiment.together)

    @property
    def rivals_before(self) -> tuple[str, ...]:
        """Everything that could have been the cause."""
        disputed = (names for names in self.before.disputed if self._name in names)
        return next(disputed, self.experiment.separates)

    @property
    def rivals_after(self) -> tuple[str, ...]:
        """Of these, what still could be."""
        return tuple(
            dict.fromkeys(name for names in self.after.explanations for name in names if name in self.rivals_before)
        )

    @property
    def realised(self) -> float | None:
        """How far the nearest explanation that it refuted lies behind in -2 ln L; None where it refuted none."""
        parted = [name for name in self.rivals_before if name not in self.rivals_after]
        return min((self.after.behind[name] for name in parted if name in self.after.behind), default=None)

    @property
    def decision(self) -> str:
        """What follows from it, in words that go after `decides`."""
        left = self.rivals_after
        if not left:
            return Message("against {names}: something else was found instead", names=series(self.rivals_before))
        if not self.separated:
            return Message("nothing: it could still be {names}", names=series(left, "or"))
        if self.each_is_there:
            return Message("that each of {names} is there", names=series(left))
        return Message.counted(
            "against {gone}: {left} remains",
            "against {gone}: {left} remain",
            count=len(left),
            gone=series([name for name in self.rivals_before if name not in left]),
            left=series(left, "or"),
        )

    @property
    def comparison(self) -> str:
        """What was expected of it, and what came."""
        return Message(
            "expected difference {expected}, realised {realised}",
            expected=deviations(self.experiment.separation),
            realised=Message("none") if self.realised is None else deviations(self.realised),
        )

    @property
    def _name(self) -> str:
        return self.experiment.separates[0]

    @property
    def _others(self) -> tuple[str, ...]:
        return self.experiment.separates[1:]

    def as_json(self) -> dict[str, Any]:
        """What the document of a loop says of it."""
        return {
            "did": self.did,
            "separated": list(self.separated),
            "decision": self.decision,
            "programme": self.experiment.programme,
            "recording": self.recording,
            "stand_time_s": self.stand_time_s,
            "expected_difference": self.experiment.separation,
            "realised_difference": self.realised,
            "rivals_before": list(self.rivals_before),
            "rivals_after": list(self.rivals_after),
            f"held_out_rms_{self.after.loop.unit}": [stage.loop.held_out_rms for stage in (self.before, self.after)],
        }
