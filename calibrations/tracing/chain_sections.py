"""How rivals were told apart, as a section of any method's report."""

from typing import Any

from tumble.calibrations.core.quantities import format_number
from tumble.calibrations.core.sentences import deviations, series
from tumble.calibrations.core.view import Section
from tumble.calibrations.tracing.chain import Chain
from tumble.calibrations.tracing.link import Link
from tumble.calibrations.tracing.stage import Stage
from tumble.messages import Message


def chain_section(chain: Chain[Any]) -> Section:
    """Every experiment with its decision and the error by then, and why it ended."""
    return Section(
        title=Message("How it was told apart"),
        lines=[each for each in (_first(chain), chain.why) if each],
        headings=(
            Message("Could be"),
            Message("Experiment"),
            Message("Time"),
            Message("Expected"),
            Message("Realised"),
            Message("Decides"),
            Message("Held-out error"),
        ),
        rows=[_row(link) for link in chain.links],
    )


def _first(chain: Chain[Any]) -> str:
    return (
        Message("Held-out error of the first measurement: {error}.", error=_error(chain.first)) if chain.links else ""
    )


def _row(link: Link[Any]) -> tuple[str, ...]:
    return (
        series(link.rivals_before, "or"),
        link.experiment.programme,
        Message("{minutes:.0f} min", minutes=link.stand_time_s / 60.0),
        deviations(link.experiment.separation),
        Message("none") if link.realised is None else deviations(link.realised),
        link.decision,
        _error(link.after),
    )


def _error(stage: Stage[Any]) -> str:
    error = stage.loop.held_out_rms
    return Message("none") if error is None else format_number(error, stage.loop.unit)
