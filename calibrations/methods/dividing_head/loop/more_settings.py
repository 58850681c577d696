"""What to measure where a table has too few settings to show what it holds."""

from collections.abc import Sequence

from tumble.calibrations.core.sentences import series
from tumble.calibrations.methods.dividing_head.loop.reach import ENOUGH, Reach
from tumble.calibrations.methods.dividing_head.probes import PROBES
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.findings import Unexplained, Withheld
from tumble.messages import Message

_ANYTHING = Message.named("lack_of_fit", "lack of fit")
"""What is to be explained where nothing that has a name came up."""

_SHAPE = Message("of what shape it is")


def more_settings(
    withheld: Sequence[Withheld], unexplained: Unexplained | None, reach: Reach
) -> tuple[Experiment, ...]:
    """A sweep of many settings where something is there that few settings do not distinguish; nothing else."""
    if not reach.few or not (withheld or unexplained):
        return ()
    (probe,) = (each for each in PROBES if each.programme == ENOUGH)
    names = tuple(each.name for each in withheld) or (_ANYTHING,)
    asked = Message("whether it is {effects}", effects=series(names, "or")) if withheld else _SHAPE
    experiment = Experiment(
        separates=names,
        programme=probe.programme,
        why=Message(
            "{settings} do not show {asked}; {programme} has 72 over a whole turn",
            settings=reach.sentence,
            asked=asked,
            programme=ENOUGH,
        ),
        command=f"tumble run --programme {ENOUGH} --serial SERIAL",
        separation=0.0,
        stand_time_s=probe.stand_time_s,
    )
    return (experiment,)
