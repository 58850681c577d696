"""A calibration on the dividing head as the store takes it."""

from collections.abc import Sequence

from tumble.calibrations.core.provenance import LimitCheck
from tumble.calibrations.core.verdict import Verdict
from tumble.calibrations.methods.dividing_head.document import result_document
from tumble.calibrations.methods.dividing_head.judging import judge
from tumble.calibrations.methods.dividing_head.loop.loop import Loop
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.records.entry import Entry

METHOD = "dividing_head"
VERSION = 1


def entry(
    calibration: Calibration,
    limits: Sequence[LimitCheck] = (),
    loop: Loop | None = None,
    verdict: Verdict | None = None,
) -> Entry:
    """A calibration to be recorded; with `loop`, closed on the same rows, the augmented model beside the declared one.

    Without `verdict` the values to use are judged here.
    """
    verdict = verdict or judge(calibration, limits, loop)
    result = result_document(calibration, loop, verdict)
    declared = loop.declared if loop else calibration
    return Entry(
        method=METHOD,
        method_version=VERSION,
        result=result,
        parameters={name: each.as_json() for name, each in declared.parameters.items()},
        augmented={name: each.as_json() for name, each in loop.augmented.parameters.items()} if loop else {},
        limits=tuple(limits),
        verdict=verdict,
    )
