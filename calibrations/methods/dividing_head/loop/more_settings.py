"""What to measure where a table has too few settings to tell what it holds."""

from collections.abc import Sequence

from tumble.calibrations.core.sentences import series
from tumble.calibrations.methods.dividing_head.loop.reach import ENOUGH, Reach
from tumble.calibrations.methods.dividing_head.probes import PROBES
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.findings import Unexplained, Withheld

_ANYTHING = "lack_of_fit"
"""What is to be told where nothing that has a name came up."""


def more_settings(
    withheld: Sequence[Withheld], unexplained: Unexplained | None, reach: Reach
) -> tuple[Experiment, ...]:
    """A sweep of many settings where something is there that few settings cannot tell; nothing else."""
    if not reach.few or not (withheld or unexplained):
        return ()
    (probe,) = (each for each in PROBES if each.programme == ENOUGH)
    names = tuple(each.name for each in withheld) or (_ANYTHING,)
    told = f"whether it is {series(names, 'or')}" if withheld else "of what shape it is"
    experiment = Experiment(
        separates=names,
        programme=probe.programme,
        why=f"{reach.sentence} cannot tell {told}; {ENOUGH} has 72 over a whole turn",
        command=f"tumble run --programme {ENOUGH} --serial SERIAL",
        separation=0.0,
        stand_time_s=probe.stand_time_s,
    )
    return (experiment,)
