"""The part of the report on how rivals were distinguished: what was run, what it decided, the error then."""

from typing import Any

import numpy as np
from markupsafe import Markup
from matplotlib.ticker import MaxNLocator

from tumble.calibrations.core.quantities import format_number
from tumble.calibrations.core.sentences import series
from tumble.calibrations.methods.dividing_head.loop.loop import Loop
from tumble.calibrations.report.drawing import BAND, COLOURS, HALF_IN, MARKERS, sheet, styled, to_svg
from tumble.calibrations.tracing.chain import Chain, Link, Stage
from tumble.calibrations.tracing.penalties import CLOSE
from tumble.messages import Message

_LEAST = 0.7
"""Standard deviations. Smaller distances are drawn here: the axis is logarithmic."""


def chain_part(chain: Chain[Loop] | None) -> dict[str, Any]:
    """Every experiment with its decision, why it ended, and a plot of the explanations."""
    if chain is None:
        return {"steps": [], "ended": "", "explanations": None, "first_error": ""}
    return {
        "steps": [_step(link) for link in chain.links],
        "ended": chain.why,
        "explanations": explanations_figure(chain) if chain.links else None,
        "first_error": _error(chain.first),
    }


def _step(link: Link[Loop]) -> dict[str, str]:
    return {
        "rivals": series(link.rivals_before, "or"),
        "programme": link.experiment.programme,
        "minutes": f"{link.stand_time_s / 60:.0f}",
        "expected": _deviations(link.experiment.separation),
        "realised": Message("none") if link.realised is None else _deviations(link.realised),
        "decision": link.decision,
        "error": _error(link.after),
    }


def _deviations(difference: float) -> str:
    """In standard deviations, of a difference in -2 ln L."""
    return f"{max(difference, 0.0) ** 0.5:.1f}"


def _error(stage: Stage[Loop]) -> str:
    """Held-out error of the declared model and of the augmented one, on everything measured by then."""
    errors = (stage.loop.declared.held_out_rms_v, stage.loop.augmented.held_out_rms_v)
    return Message.joined(" → ", (Message("none") if error is None else format_number(error, "V") for error in errors))


@styled
def explanations_figure(chain: Chain[Loop]) -> Markup:
    """How far each explanation lies behind the best after each measurement; the band holds those that remain."""
    names = list(dict.fromkeys(name for stage in chain.stages for names in stage.disputed for name in names))
    figure, (panel,) = sheet(HALF_IN + 1.5, 2.8)
    panel.axhspan(_LEAST, CLOSE**0.5, color=BAND, alpha=0.18, linewidth=0)
    for number, name in enumerate(names):
        behind = [stage.behind.get(name, np.nan) for stage in chain.stages]
        panel.plot(
            range(len(behind)),
            np.maximum(np.sqrt(np.maximum(behind, 0.0)), _LEAST),
            marker=MARKERS[number % len(MARKERS)],
            color=COLOURS[number % len(COLOURS)],
            markersize=4,
            linewidth=1.0,
            label=name,
        )
    panel.set_yscale("log")
    panel.xaxis.set_major_locator(MaxNLocator(integer=True))
    panel.set_xlabel(Message("experiments run"))
    panel.set_ylabel(Message("behind the best (standard deviations)"))
    panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return to_svg(
        figure,
        "explanations",
        Message("Explanations after each experiment: {names}", names=Message.joined(", ", names)),
    )
