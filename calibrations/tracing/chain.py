"""The chain from a residual to a name: rivals, experiment, decision, and the error before and after."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import takewhile
from typing import Any, Final, Generic, Protocol, TypeVar

from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.core.sentences import deviations, series
from tumble.calibrations.tracing.experiments import Experiment, locating_experiments, next_experiments
from tumble.calibrations.tracing.explained import Explained
from tumble.calibrations.tracing.findings import EffectFound
from tumble.calibrations.tracing.places import places
from tumble.calibrations.tracing.probe import Probe
from tumble.calibrations.tracing.rivals import rivals
from tumble.calibrations.tracing.separation import APART
from tumble.calibrations.tracing.table import Extensible
from tumble.messages import Message

FUTILE = 2
"""After so many experiments in a row that separated nothing, none is run any more."""
_PATIENCE: Final = 4
"""After so many that separated nothing, whatever they were parts of, neither."""
_MOST_NEAR = 8
"""Of explanations that are not quite rivals only the nearest are planned for, where there are many."""


class Ended(StrEnum):
    """Why no further experiment is run."""

    NOTHING_TO_TELL = "nothing to tell apart"
    TOLD_APART = "told apart"
    NOTHING_AVAILABLE = "no available experiment"
    NOT_AS_PROMISED = "not as promised"
    ENOUGH = "as many as were asked for"

    @property
    def words(self) -> Message:
        """The same for a reader."""
        return _ENDINGS[self]


_ENDINGS: Final = {
    Ended.NOTHING_TO_TELL: Message("nothing to tell apart"),
    Ended.TOLD_APART: Message("told apart"),
    Ended.NOTHING_AVAILABLE: Message("no available experiment"),
    Ended.NOT_AS_PROMISED: Message("not as promised"),
    Ended.ENOUGH: Message("as many as were asked for"),
}


class ClosedLoop(Protocol):
    """What a chain needs to know of a loop that was closed on a table."""

    @property
    def effects(self) -> tuple[EffectFound, ...]:
        """What was found."""
        ...

    @property
    def held_out_rms(self) -> float | None:
        """Error of rows that are held out, in the unit of the output; None where none can be."""
        ...

    @property
    def unit(self) -> str:
        """Of the output."""
        ...


L = TypeVar("L", bound=ClosedLoop)
"""The loop of a method."""
_T = TypeVar("_T", bound=Extensible)


@dataclass(frozen=True, kw_only=True)
class Stage(Generic[L]):
    """The loop closed on everything that was measured so far."""

    loop: L
    behind: Mapping[str, float]
    """How far each explanation lies behind the best in -2 ln L, 0 for what was found."""
    places: tuple[str, ...] = ()
    """Where structure without a name may live, the nearest first; empty where there is none."""

    @property
    def explanations(self) -> tuple[tuple[str, ...], ...]:
        """For everything that was found, its name and those of its rivals."""
        named = tuple((effect.name, *effect.also_possible) for effect in self.loop.effects)
        return (*named, self.places) if self.places else named

    @property
    def disputed(self) -> tuple[tuple[str, ...], ...]:
        """The same for what has rivals."""
        return tuple(names for names in self.explanations if len(names) > 1)


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


@dataclass(frozen=True, kw_only=True)
class Chain(Generic[L]):
    """All of it: where it began, every experiment, why it ended."""

    first: Stage[L]
    links: tuple[Link[L], ...] = ()
    ended: Ended | None = None
    """None while it goes on."""
    why: str = ""
    """A sentence or several."""

    @property
    def last(self) -> Stage[L]:
        """What is known now."""
        return self.links[-1].after if self.links else self.first

    @property
    def stages(self) -> tuple[Stage[L], ...]:
        """What was known after each measurement."""
        return (self.first, *(link.after for link in self.links))

    @property
    def doubted(self) -> frozenset[str]:
        """What had rivals before an experiment was run, and these, as far as that was not confirmed since.

        Nothing while anything has rivals still.
        """
        if self.last.disputed:
            return frozenset()
        doubted = {name for link in self.links for names in link.before.disputed for name in names}
        return frozenset(doubted.difference(*(link.experiment.separates for link in self.links if link.confirmed)))

    @property
    def futile(self) -> int:
        """How many experiments in a row have separated nothing, though each was to do so by itself."""
        count = 0
        for link in reversed(self.links):
            if not link.futile:
                break
            count += 1
        return count

    @property
    def in_vain(self) -> tuple[Link[L], ...]:
        """The last experiments in a row that separated nothing, the last one first."""
        return tuple(takewhile(lambda link: not link.separated, reversed(self.links)))

    @property
    def unkept(self) -> bool:
        """Whether a plan of several runs was carried out, or begun anew, and separated nothing in any of them."""
        return len(self.in_vain) >= _PATIENCE or any(
            1 < link.planned <= sum(each.experiment.programme in link.programmes for each in self.in_vain[:since])
            for since, link in enumerate(self.in_vain, start=1)
        )

    def as_json(self) -> dict[str, Any]:
        """What it adds to the document of the loop."""
        return {
            "experiments": [_link_json(link) for link in self.links],
            "ended": {"how": self.ended, "why": self.why},
        }


def _link_json(link: Link[Any]) -> dict[str, Any]:
    return {
        "did": link.did,
        "separated": list(link.separated),
        "decision": link.decision,
        "programme": link.experiment.programme,
        "recording": link.recording,
        "stand_time_s": link.stand_time_s,
        "expected_difference": link.experiment.separation,
        "realised_difference": link.realised,
        "rivals_before": list(link.rivals_before),
        "rivals_after": list(link.rivals_after),
        f"held_out_rms_{link.after.loop.unit}": [stage.loop.held_out_rms for stage in (link.before, link.after)],
    }


@one_blas_thread
def stage_of(loop: L, explained: Explained[Any, Any] | None, asked: Collection[str] = ()) -> Stage[L]:
    """What a table says, with every explanation that is near, and those that are `asked` for."""
    behind: dict[str, float] = {}
    if explained is not None:
        for name in explained.trace.names:
            for rival in rivals(explained.tracer, explained.trace, name, asked):
                further = rival.trace.deviance - explained.trace.deviance
                behind[rival.name] = min(further, behind.get(rival.name, further))
        behind |= dict.fromkeys(explained.trace.names, 0.0)
        return Stage(loop=loop, behind=behind, places=places(explained.trace, explained.alike))
    return Stage(loop=loop, behind=behind)


@one_blas_thread
def experiments_for(
    explained: Explained[_T, Any] | None, probes: Sequence[Probe], otherwise: str = "", doubted: Collection[str] = ()
) -> tuple[Experiment, ...]:
    """What would tell apart the rivals of a table, of what can be run.

    Explanations a little too far behind to be rivals are distinguished too: by mere chance the true one may be there.
    Of what has no rival left, so are those that were `doubted` before, where a single run is enough.
    """
    if explained is None:
        return ()
    close = {name: found for name, found in explained.close.items() if found}
    near = {name: explained.near[name][: max(len(found), _MOST_NEAR)] for name, found in close.items()}
    barely = {
        name: found
        for name, listed in explained.near.items()
        if name in doubted and name not in close and (found := [each for each in listed if each.name in doubted])
    }
    confirming = next_experiments(explained.table, explained.trace, barely, probes)
    return (
        *next_experiments(explained.table, explained.trace, near, probes, otherwise),
        *(each for each in confirming if each.command and each.runs == 1 and not each.together),
        *locating_experiments(explained.table, explained.trace, explained.alike, probes, otherwise),
    )


def cheapest(experiments: Sequence[Experiment]) -> Experiment | None:
    """The experiment that tells most explanations apart for its time at the stand; None where none tells anything."""
    time_s = {each.programme: each.stand_time_s for each in experiments}

    def worth(experiment: Experiment) -> float:
        whole_s = experiment.stand_time_s + sum(time_s.get(name, 0.0) for name in experiment.together)
        return (len(experiment.separates) - 1) / whole_s

    return max((each for each in experiments if each.command), key=worth, default=None)


def cannot(experiments: Sequence[Experiment], elsewhere: Mapping[str, tuple[Experiment, str]]) -> str:
    """Why nothing more is distinguished.

    Parameters
    ----------
    experiments
        Those without a programme: what nothing tells apart.
    elsewhere
        By programme, an experiment that would help, and why it cannot be run.
    """
    nothing = [each for each in experiments if not each.command]
    sentences = [
        Message(
            "No experiment that can be run here tells {name} from {rivals}: they would differ by {difference} at most, "
            "and {needed:.0f} are needed.",
            name=each.separates[0],
            rivals=series(each.separates[1:], "or"),
            difference=deviations(each.separation),
            needed=APART**0.5,
        )
        for each in nothing
    ]
    sentences += [Message("What is left to do: {remedy}.", remedy=each.remedy) for each in nothing if each.remedy]
    sentences += [
        Message(
            "{programme} would tell {name} from {rivals}, but it cannot be run here: {reason}.",
            programme=programme,
            name=each.separates[0],
            rivals=series(each.separates[1:]),
            reason=reason,
        )
        for programme, (each, reason) in elsewhere.items()
    ]
    return Message.joined(" ", sentences) if sentences else ""
