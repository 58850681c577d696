"""What to measure next: positions that tell what a table does not, and what parts what no position parts."""

from collections.abc import Iterator
from typing import Final

from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.core.sentences import series
from tumble.calibrations.methods.gyrocompass.fit import GyrocompassFit
from tumble.calibrations.methods.gyrocompass.probes import PROBES, probes, usual_step_s
from tumble.calibrations.methods.gyrocompass.table import GyrocompassTable
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.explained import Explained
from tumble.calibrations.tracing.next_run import experiments_for
from tumble.messages import Message

OTHERWISE: Final = Message(
    "let the base lean otherwise (parts what goes with the tilt), shield the platform (parts a magnetic field), take "
    "the heading from an azimuth mark, or check the stated latitude"
)


@one_blas_thread
def next_experiments(
    explained: Explained[GyrocompassTable, GyrocompassFit], headings_deg: tuple[float, ...]
) -> tuple[Experiment, ...]:
    """For every effect that has rivals, what tells it from them in the least time; else what is missing.

    What the positions do not tell of heading and drift at all is asked for first.
    """
    step_s = usual_step_s(explained.table.observations)
    return (*_unseen(explained, headings_deg, step_s), *experiments_for(explained, probes(step_s), OTHERWISE))


def _unseen(
    explained: Explained[GyrocompassTable, GyrocompassFit], headings_deg: tuple[float, ...], step_s: float
) -> Iterator[Experiment]:
    names = [name for name, each in explained.best.parameters().items() if each.value is None]
    if len(headings_deg) > 1:
        names = [f"{each:.3f}°" for each in headings_deg]
    if names:
        first = PROBES[0]
        yield Experiment(
            separates=tuple(names),
            programme=first.programme,
            why=Message(
                "these positions do not tell {names}; programme {programme} does",
                names=series(names),
                programme=first.programme,
            ),
            command=first.command,
            separation=0.0,
            stand_time_s=step_s * len(first.azimuths_deg),
        )
