"""What is not identifiable from a table of runs, in sentences, each with the experiment that would help."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from tumble.calibrations.core.sentences import series
from tumble.calibrations.methods.temperature.effects import BREAK, DRIFT
from tumble.calibrations.methods.temperature.settled import RunTable
from tumble.calibrations.methods.temperature.shared import SharedCause
from tumble.calibrations.methods.temperature.table import Runs
from tumble.calibrations.tracing.linear_loop import LinearExplained
from tumble.messages import Message

_FEW = 2
"""A break with so few runs on one side could as well be a bend or a step."""


def limits(
    runs: Runs, explained: Mapping[str, LinearExplained[RunTable]], shared: Sequence[SharedCause]
) -> tuple[str, ...]:
    """Sentences on what is not identifiable, the most general first."""
    return (
        *_order(runs),
        *_repeats(runs),
        *_withheld(explained),
        *_thin_breaks(runs, explained),
        *_rivals(explained),
        *_near_causes(shared),
    )


def _order(runs: Runs) -> Iterator[str]:
    """Temperature and order of the runs rise or fall together."""
    steps = np.diff(runs.temperature_degc[np.argsort(runs.order)])
    if (steps > 0).all() or (steps < 0).all():
        way = Message("warmer") if steps[0] > 0 else Message("colder")
        yield Message(
            "Every run was {way} than the one before it, so that ageing or drift from run to run looks much like "
            "temperature; one more run at {first_degc:.0f} °C at the end would tell them apart.",
            way=way,
            first_degc=runs.temperature_degc[np.argmin(runs.order)],
        )


def _repeats(runs: Runs) -> Iterator[str]:
    if len(np.unique(np.round(runs.temperature_degc, 1))) == len(runs):
        yield Message(
            "No temperature was visited twice, so that nothing but what a fit leaves says how well a run repeats; "
            "two more runs, say at {highest_degc:.0f} and {middle_degc:.0f} °C, would.",
            highest_degc=runs.temperature_degc.max(),
            middle_degc=float(np.median(runs.temperature_degc)),
        )


def _withheld(explained: Mapping[str, LinearExplained[RunTable]]) -> Iterator[str]:
    """Effects that would fit the runs and do not stand on the temperatures."""
    for name, one in explained.items():
        yield from (Message("In {parameter}, {sentence}", parameter=name, sentence=each) for each in one.withheld)


def _thin_breaks(runs: Runs, explained: Mapping[str, LinearExplained[RunTable]]) -> Iterator[str]:
    """Breaks beyond which there are hardly any runs."""
    thin: dict[tuple[float, ...], list[str]] = {}
    for name, one in explained.items():
        for item in one.trace.found:
            if item.effect.name == BREAK:
                beyond = runs.temperature_degc[runs.temperature_degc > item.form.scanned["at_degC"]]
                if len(beyond) <= _FEW:
                    thin.setdefault(tuple(beyond.tolist()), []).append(name)
    for above, names in thin.items():
        below = float(runs.temperature_degc[runs.temperature_degc < min(above)].max())
        yield Message.counted(
            "The break of {parameters} rests on {count} run ({temperatures} °C): whether it is a break, a step or a "
            "bend is not distinguishable; runs at {between_degc:.0f} °C and two above it would tell.",
            "The break of {parameters} rests on {count} runs ({temperatures} °C): whether it is a break, a step or a "
            "bend is not distinguishable; runs at {between_degc:.0f} °C and two above it would tell.",
            count=len(above),
            parameters=series(names),
            temperatures=series([f"{at:.0f}" for at in above]),
            between_degc=(below + min(above)) / 2,
        )


def _rivals(explained: Mapping[str, LinearExplained[RunTable]]) -> Iterator[str]:
    """Effects that explain a parameter as well as those that were found."""
    for name, one in explained.items():
        for effect, rivals in one.close.items():
            if rivals:
                others = [rival.name for rival in rivals]
                yield Message(
                    "In {parameter}, {effect} is not distinguishable from {others}; {remedy}.",
                    parameter=name,
                    effect=effect,
                    others=series(others, "or"),
                    remedy=_remedy({effect, *others}),
                )


def _remedy(names: set[str]) -> str:
    if DRIFT in names:
        return Message("a run at a temperature that was visited before would tell")
    return Message("runs between those that there are would tell")


def _near_causes(shared: Sequence[SharedCause]) -> Iterator[str]:
    for cause in shared:
        if not cause.one:
            low, high = cause.between_degc
            yield Message(
                "Whether {parameters} break at one temperature is not identifiable: all break between {low:.0f} and "
                "{high:.0f} °C, where there is no run; one in the middle would tell.",
                parameters=series(cause.parameters),
                low=low,
                high=high,
            )
