"""What to measure next: mountings that tell what a table does not, and programmes that tell rivals apart."""

from collections.abc import Iterator
from typing import Final

from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.core.sentences import series
from tumble.calibrations.methods.vibration.fit import VibrationFit
from tumble.calibrations.methods.vibration.model import NAMES
from tumble.calibrations.methods.vibration.observations import DOUBLE_CENTRIFUGE, MULTI_SHAKER, VibrationObservations
from tumble.calibrations.methods.vibration.probes import PROBES, VibrationProbe, probes, usual_step_s
from tumble.calibrations.methods.vibration.table import VibrationTable
from tumble.calibrations.tracing.experiments import Experiment, locating_experiments
from tumble.calibrations.tracing.experiments import next_experiments as tell_apart
from tumble.calibrations.tracing.explained import Explained
from tumble.messages import Message

_BY_NAME: Final = {probe.programme: probe for probe in PROBES}
_ROOM: Final = 32
"""Mountings that a plan may have, each with a rest output of its own."""
_SQUARES: Final = frozenset(NAMES[:3])


@one_blas_thread
def next_experiments(explained: Explained[VibrationTable, VibrationFit]) -> tuple[Experiment, ...]:
    """For every effect that has rivals, what tells it from them in the least time; first what is missing altogether."""
    step_s = usual_step_s(explained.table.observations)
    known, table = probes(step_s), explained.table.with_room(_ROOM)
    close = {name: found for name, found in explained.close.items() if found}
    return (
        *_unseen(explained, step_s),
        *tell_apart(table, explained.trace, close, known),
        *locating_experiments(table, explained.trace, explained.alike, known),
    )


def _unseen(explained: Explained[VibrationTable, VibrationFit], step_s: float) -> Iterator[Experiment]:
    """What identifies coefficients that no dwell tells."""
    parameters = explained.best.parameters()
    names = [name for name in NAMES if parameters[name].value is None]
    if not names:
        return
    probe = _telling(explained.table.observations, names)
    yield Experiment(
        separates=tuple(names),
        programme=probe.programme,
        why=Message(
            "these dwells do not identify {names}; {programme} does: it {does}",
            names=series(names),
            programme=probe.programme,
            does=probe.does,
        ),
        command=probe.command,
        separation=0.0,
        stand_time_s=step_s / probe.step_s * probe.stand_time_s,
    )


def _telling(rows: VibrationObservations, names: list[str]) -> VibrationProbe:
    """The programme that tells coefficients on the apparatus that is there."""
    if (rows.of_apparatus == MULTI_SHAKER).all():
        return _BY_NAME["vibration-phases"]
    if (rows.of_apparatus == DOUBLE_CENTRIFUGE).all() and _SQUARES.issuperset(names):
        return _BY_NAME["vibration-centrifuge"]
    return _BY_NAME["vibration-fixtures"]
