"""The middle of the report: significance and identifiability, fit, residuals, flips, noise and rows."""

from collections.abc import Iterator
from typing import Final

from tumble.calibrations.core.quantities import format_concise, format_number
from tumble.calibrations.core.sentences import equals
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.dividing_head.joint import LACK_OF_FIT_P
from tumble.calibrations.methods.dividing_head.report.figures import closure_figure, fit_figure, model_curve
from tumble.calibrations.methods.dividing_head.report.residuals import angle_figure, covariate_figure
from tumble.calibrations.methods.dividing_head.report.subject import Subject, mounts_of
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.methods.dividing_head.significance import closure_sentence, statements
from tumble.calibrations.report.document import Picture
from tumble.messages import Message

LISTED_ROWS = 50
"""Of the rows set aside so many are listed, the rest counted."""


def significance_sections(subject: Subject) -> Iterator[Section]:
    """The statements, each with the names it is about."""
    yield Section(title="", lines=[statement.text for statement in statements(subject.use.calibration)])


def fit_picture(calibration: Calibration) -> Picture:
    """Output against angle, with the curve of the model where it could be drawn."""
    drawn = model_curve(calibration, mounts_of(calibration.observations)[0]) is not None
    return Picture(figure=fit_figure(calibration), caption=_DRAWN if drawn else _NOT_DRAWN)


_DRAWN: Final = Message("Every dwell that was used, with the declared model at the fitted parameters (line).")
_NOT_DRAWN: Final = Message(
    "Every dwell that was used, with no curve: the data fixes combinations of the parameters that no single parameter "
    "states."
)


def residual_sections(subject: Subject) -> Iterator[Section]:
    """Residual plots; what the band is and whether rows are weighted."""
    calibration = subject.calibration
    yield Section(
        title="",
        lines=[Message.joined(" ", [_measured_minus_fitted(calibration), _band(calibration), _GREY])],
        figure=lambda: angle_figure(calibration),
        caption=Message("Against the head angle within one turn. Each coloured mark is the mean of one repeated pose."),
    )
    yield Section(
        title="",
        figure=lambda: covariate_figure(calibration),
        caption=Message("The last: normal probability plot; the line is normal scatter of the same size."),
    )


def _measured_minus_fitted(calibration: Calibration) -> Message:
    if calibration.weights.max() > calibration.weights.min():
        return Message("Measured minus fitted, times the root of the weight of the row.")
    return Message("Measured minus fitted.")


def _band(calibration: Calibration) -> Message:
    noise = calibration.noise
    if noise.pure_error_v is not None:
        band = format_number(noise.pure_error_v, "V")
        return Message("The band is ± {band}, the scatter of one dwell between repeats of its pose.", band=band)
    band = format_number(noise.used_v, "V")
    return Message("The band is ± {band}, the scatter about the fit; no pose was repeated.", band=band)


_GREY: Final = Message(
    "Grey: single dwells. Coloured: means of groups of rows, with twice their standard uncertainty from the band."
)


def closure_sections(subject: Subject) -> Iterator[Section]:
    """u0 of the flips; without flips there is no figure."""
    found = subject.calibration.closure
    if found is None:
        yield Section(
            title="",
            lines=[
                Message(
                    "The table holds no complete 180° flip: a term such as k_xx, which sweeps alone cannot show, stays "
                    "unseen."
                )
            ],
        )
        return
    yield Section(
        title="",
        lines=[closure_sentence(found)],
        figure=lambda: closure_figure(found),
        caption=Message(
            "u0 as each flip alone gives it, with one (thick) and two (thin) standard uncertainties of the scatter of "
            "repeats."
        ),
        headings=(Message("Flip"), Message("u0 (standard uncertainty)"), Message("minus the declared model")),
        rows=[
            (axis, format_concise(mean.u0_v, mean.standard_uncertainty_v, "V"),
             format_number(mean.u0_v - mean.expected_v, "V", 2))
            for axis, mean in found.axes.items()
        ],
    )  # fmt: skip


def quality_sections(subject: Subject) -> Iterator[Section]:
    """Noise, lack of fit and held-out error with an explanation each; the rows that were set aside."""
    observations = subject.calibration.observations
    yield Section(
        title="",
        headings=(Message("Quantity"), Message("Size"), Message("What it says")),
        rows=_quality_figures(subject.calibration),
    )
    set_aside = observations.set_aside
    yield Section(
        title="",
        lines=[
            Message.counted(
                "{count} row read, {used} used, {set_aside} set aside.",
                "{count} rows read, {used} used, {set_aside} set aside.",
                count=observations.rows_read,
                used=len(observations),
                set_aside=len(set_aside),
            )
        ],
    )
    if not set_aside:
        return
    listed = set_aside[:LISTED_ROWS]
    title = Message("Rows set aside")
    if len(set_aside) > len(listed):
        title = Message("Rows set aside, the first {listed} of {count}", listed=len(listed), count=len(set_aside))
    rows = [Message("row {row}: {reason}", row=entry.row, reason=entry.reason) for entry in listed]
    yield Section(
        title=title,
        lines=[Message("Row 1 is the first data row."), Message("{rows}.", rows=Message.joined("; ", rows))],
    )


def _quality_figures(calibration: Calibration) -> list[tuple[str, str, str]]:
    noise = calibration.noise
    return [
        _pure_error(calibration),
        (
            Message("Noise of one dwell"),
            format_number(noise.used_v, "V"),
            Message(
                "what the uncertainties rest on: {basis}; degrees of freedom: {freedom}",
                basis=noise.basis,
                freedom=noise.used_degrees_of_freedom,
            ),
        ),
        (
            Message("Residual, r.m.s."),
            format_number(calibration.residual_rms_v, "V"),
            Message("measured minus fitted, all rows used"),
        ),
        _held_out(calibration),
        _lack_of_fit(calibration),
    ]


def _pure_error(calibration: Calibration) -> tuple[str, str, str]:
    noise = calibration.noise
    if noise.pure_error_v is None:
        return (
            Message("Pure error"),
            Message("none"),
            Message("no pose was repeated, so that nothing but the model says how much the data scatters"),
        )
    text = Message(
        "scatter of one dwell mean between repeats of its pose; degrees of freedom: {freedom}",
        freedom=noise.degrees_of_freedom,
    )
    return (Message("Pure error"), format_number(noise.pure_error_v, "V"), text)


def _held_out(calibration: Calibration) -> tuple[str, str, str]:
    if calibration.held_out_rms_v is None:
        return (
            Message("Held-out error, r.m.s."),
            Message("none"),
            Message("too few rows to fit some and predict the others"),
        )
    ratio = calibration.held_out_rms_v / calibration.residual_rms_v if calibration.residual_rms_v > 0 else 1.0
    text = Message("error of predicting rows that took no part in the fit: {ratio:.2f} times the residual", ratio=ratio)
    return (Message("Held-out error, r.m.s."), format_number(calibration.held_out_rms_v, "V"), text)


def _lack_of_fit(calibration: Calibration) -> tuple[str, str, str]:
    p_value = calibration.lack_of_fit_p
    if p_value is None:
        return (
            Message("Lack of fit"),
            Message("not tested"),
            Message("the test needs repeats and more poses than parameters"),
        )
    text = (
        Message("the poses disagree with the model by more than the repeats explain")
        if p_value < LACK_OF_FIT_P
        else Message("the poses agree with the model as well as the repeats agree with each other")
    )
    return (Message("Lack of fit"), f"p {equals(p_value)}", text)
