"""Reduced dwells as they are shown: what each was vibrated with, its mean, and its rectification."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Final

from markupsafe import Markup

from tumble.calibrations.core.quantities import format_concise
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.vibration.dwells.reduction import Estimate, ReducedDwell, Reduction
from tumble.calibrations.methods.vibration.dwells.rows import rows_of
from tumble.calibrations.methods.vibration.observations import VibrationObservations
from tumble.messages import Message

_DRAWN: Final = 6
"""Dwells that are drawn at most."""


@dataclass(frozen=True, kw_only=True)
class ReducedSamples:
    """Fits `tumble.calibrations.core.reducing.Reduced`."""

    reduction: Reduction
    title: str = Message("Dwells at rest and under vibration")

    @property
    def warnings(self) -> tuple[str, ...]:
        """What refuses to be reduced, and what was odd."""
        return self.reduction.warnings

    def document(self) -> dict[str, Any]:
        """The result as `tumble.dwells/1`."""
        return self.reduction.document()

    def rows(self, mounting: int) -> VibrationObservations:
        """One row for each dwell that has a mean."""
        return rows_of(self.reduction, mounting)

    def sections(self) -> Sequence[Section]:
        """Rectification, dwells, and their pictures."""
        found = self.reduction.rectifications
        drawn = [each for each in self.reduction.dwells if each.vibrated][:_DRAWN]
        return (
            Section(
                title=Message("Rectification"),
                headings=(Message("Dwell"), Message("Against both rests")),
                rows=[(str(number), _said(each)) for number, each in found.items()],
                brief=True,
            ),
            Section(
                title=Message("Dwells"),
                headings=(
                    Message("Dwell"),
                    Message("Mean"),
                    Message("frequency (Hz)"),
                    Message("amplitude (g)"),
                    "m_ii (g²)",
                    "m_io (g²)",
                ),
                rows=[_row(each) for each in self.reduction.dwells],
                brief=True,
            ),
            *(_picture(each) for each in drawn),
        )


def _said(estimate: Estimate) -> str:
    if estimate.value_ug is None or estimate.standard_uncertainty_ug is None:
        return Message("none: {reason}", reason=estimate.reason)
    return format_concise(estimate.value_ug, estimate.standard_uncertainty_ug, "µg")


def _row(dwell: ReducedDwell) -> Sequence[str]:
    numbers = (dwell.frequency_hz, dwell.amplitude_g, dwell.products.ii_g2, dwell.products.io_g2)
    return (str(dwell.samples.dwell), _said(dwell.mean), *("—" if each is None else f"{each:.6g}" for each in numbers))


def _picture(dwell: ReducedDwell) -> Section:
    return Section(
        title=Message("Dwell {number}", number=dwell.samples.dwell),
        figure=partial(_draw, dwell),
        caption=Message("Power spectral density of output and reference, and the first samples of both."),
    )


def _draw(dwell: ReducedDwell) -> Markup:
    from tumble.calibrations.methods.vibration.figures import dwell_figure  # matplotlib takes half a second

    return dwell_figure(dwell)
