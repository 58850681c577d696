"""Which experiment is run next, or why none can tell more."""

from collections.abc import Collection, Mapping, Sequence
from typing import Any, Final, TypeVar

from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.core.sentences import deviations, series
from tumble.calibrations.tracing.experiments import Experiment, locating_experiments, next_experiments
from tumble.calibrations.tracing.explained import Explained
from tumble.calibrations.tracing.probe import Probe
from tumble.calibrations.tracing.separation import APART
from tumble.calibrations.tracing.table import Extensible
from tumble.messages import Message

_MOST_NEAR: Final = 8
"""Of explanations that are not quite rivals only the nearest are planned for, where there are many."""
_T = TypeVar("_T", bound=Extensible)


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
