"""What to measure next: positions that identify what a table does not, and lists that tell rivals apart."""

from collections.abc import Iterator

from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.core.sentences import series
from tumble.calibrations.methods.triad.fit import TriadFit
from tumble.calibrations.methods.triad.probes import probes, usual_step_s
from tumble.calibrations.methods.triad.programmes import POSITIONS
from tumble.calibrations.methods.triad.table import TriadTable
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.explained import Explained
from tumble.calibrations.tracing.next_run import experiments_for
from tumble.messages import Message


@one_blas_thread
def next_experiments(explained: Explained[TriadTable, TriadFit]) -> tuple[Experiment, ...]:
    """For every effect that has rivals, what tells it from them in the least time; else what is missing.

    What the positions do not tell of the parameters at all is asked for first.
    """
    step_s = usual_step_s(explained.table.observations)
    return (*_unseen(explained, step_s), *experiments_for(explained, probes(step_s)))


def _unseen(explained: Explained[TriadTable, TriadFit], step_s: float) -> Iterator[Experiment]:
    names = [name for name, each in explained.best.parameters().items() if each.value is None]
    if names:
        yield Experiment(
            separates=tuple(names),
            programme="24",
            why=Message(
                "these positions do not identify {names}; the 24 positions of programme 24 do", names=series(names)
            ),
            command="tumble run --programme 24 --serial SERIAL",
            separation=0.0,
            stand_time_s=step_s * len(POSITIONS["24"]),
        )
