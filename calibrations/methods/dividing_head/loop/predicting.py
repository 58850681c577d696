"""Whether what was found predicts rows that were held out, or describes the rows that it was found in only."""

from dataclasses import replace
from typing import Any, Final

from tumble.calibrations.methods.dividing_head.held_out import held_out_parts
from tumble.calibrations.methods.dividing_head.loop.table import DividingHeadTable
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.tracing.held_out import held_out_rms
from tumble.calibrations.tracing.trace import Trace, Tracer
from tumble.messages import Message

_LESS: Final = 1.0 - 1e-6
"""What differs by less was predicted by the declared model all the same."""


def with_held_out(
    stated: Calibration, declared: Calibration, tracer: Tracer[Any], trace: Trace, table: DividingHeadTable
) -> Calibration:
    """The same with the error of rows held out, predicted with what was found; with a warning where that is no less.

    Of what wanders, or jumps from seat to seat, no prediction is expected.
    """
    if not (trace.found or trace.names or trace.components):
        return stated
    after = held_out_rms(tracer, trace, held_out_parts(table.observations))
    stated = replace(stated, held_out_rms_v=after)
    before = declared.held_out_rms_v
    if after is None or before is None or after < _LESS * before or not (trace.found or trace.components):
        return stated
    warning = Message(
        "{source}: what was found describes these rows only; rows held out are predicted no better with it than by the "
        "declared model",
        source=stated.observations.source,
    )
    return replace(stated, warnings=(*stated.warnings, warning))
