"""Structure that no effect of the catalogue explains, or settings that differ in no shape."""

from collections.abc import Sequence
from typing import Any

from tumble.calibrations.core.quantities import format_number
from tumble.calibrations.methods.dividing_head.loop.reach import Reach
from tumble.calibrations.tracing import findings
from tumble.calibrations.tracing.courses import Course
from tumble.calibrations.tracing.findings import SHAPELESS_P, Unexplained
from tumble.calibrations.tracing.judged import Judged
from tumble.calibrations.tracing.trace import Trace
from tumble.calibrations.tracing.variables import VARIABLE_WORDS
from tumble.messages import Message


def unexplained(
    found: Judged[Any], reach: Reach, others: Sequence[Trace] = (), known: Sequence[Course] = ()
) -> Unexplained | None:
    """Structure that no effect of the catalogue explains, and what `others` could stand for it; None for none.

    `known` are the courses of the components of the trace.
    """
    if structure := findings.unexplained(found.trace, others, known):
        return structure
    has_name = found.trace.names and not found.withheld
    return None if has_name or reach.alike > SHAPELESS_P else _shapeless(reach)


def _shapeless(reach: Reach) -> Unexplained:
    """Settings that differ from the model by more than their repeats, too few to show in what shape."""
    differ_by, scatter = (format_number(each, reach.unit, 2) for each in (reach.differ_by, reach.scatter))
    return Unexplained(
        depends_on=VARIABLE_WORDS["acceleration" if reach.mounts > 1 else "angle"],
        shaped=False,
        description=Message(
            "{settings} differ from the model by {differ_by} where repeats scatter by {scatter}, in no shape "
            "that so many can show",
            settings=reach.sentence,
            differ_by=differ_by,
            scatter=scatter,
        ),
    )
