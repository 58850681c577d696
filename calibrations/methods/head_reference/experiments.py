"""Which experiment with head and reference would tell apart what a table cannot."""

from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.methods.head_reference.probes import probes
from tumble.calibrations.methods.head_reference.table import HeadTable
from tumble.calibrations.tracing.experiments import Experiment, next_experiments
from tumble.calibrations.tracing.linear_loop import LinearExplained
from tumble.messages import Message

_OTHERWISE = Message("use another reference")


@one_blas_thread
def next_reference_experiments(explained: LinearExplained[HeadTable]) -> tuple[Experiment, ...]:
    """For every effect that has rivals: the experiments that tell it from them, in the least time."""
    table = explained.table
    return next_experiments(table, explained.trace, explained.close, probes(table.observations), _OTHERWISE)
