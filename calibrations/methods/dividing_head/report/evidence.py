"""The middle of the report: significance and identifiability, fit, residuals, flips, noise and rows."""

from typing import Any

from tumble.calibrations.core.quantities import format_concise, format_number
from tumble.calibrations.core.sentences import equals
from tumble.calibrations.methods.dividing_head.joint import LACK_OF_FIT_P
from tumble.calibrations.methods.dividing_head.report.figures import closure_figure, fit_figure, model_curve
from tumble.calibrations.methods.dividing_head.report.residuals import angle_figure, covariate_figures, normal_figure
from tumble.calibrations.methods.dividing_head.report.subject import Subject, mounts_of
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.methods.dividing_head.significance import closure_sentence, statements
from tumble.messages import Message

LISTED_ROWS = 50
"""Of the rows set aside so many are listed, the rest counted."""


def significance(subject: Subject) -> dict[str, Any]:
    """The statements, each with the names it is about."""
    return {"statements": statements(subject.use.calibration)}


def fit(subject: Subject) -> dict[str, Any]:
    """Output against angle; whether the model's curve could be drawn."""
    calibration = subject.calibration
    mounts = mounts_of(calibration.observations)
    return {"figure": fit_figure(calibration), "drawn": model_curve(calibration, mounts[0]) is not None}


def residuals(subject: Subject) -> dict[str, Any]:
    """Residual plots; what the band is and whether rows are weighted."""
    calibration = subject.calibration
    noise = calibration.noise
    return {
        "angle": angle_figure(calibration),
        "covariates": list(covariate_figures(calibration).values()),
        "normal": normal_figure(calibration),
        "band": format_number(noise.used_v if noise.pure_error_v is None else noise.pure_error_v, "V"),
        "from_repeats": noise.pure_error_v is not None,
        "weighted": bool(calibration.weights.max() > calibration.weights.min()),
    }


def closure(subject: Subject) -> dict[str, Any]:
    """u0 of the flips; without flips there is no figure."""
    found = subject.calibration.closure
    if found is None:
        return {"figure": None}
    return {
        "figure": closure_figure(found),
        "sentence": closure_sentence(found),
        "axes": [
            (axis, format_concise(mean.u0_v, mean.standard_uncertainty_v, "V"),
             format_number(mean.u0_v - mean.expected_v, "V", 2))
            for axis, mean in found.axes.items()
        ],
    }  # fmt: skip


def quality(subject: Subject) -> dict[str, Any]:
    """Noise, lack of fit and held-out error with an explanation each; the rows that were set aside."""
    observations = subject.calibration.observations
    return {
        "figures": _quality_figures(subject.calibration),
        "read": observations.rows_read,
        "used": len(observations),
        "set_aside": observations.set_aside[:LISTED_ROWS],
        "set_aside_count": len(observations.set_aside),
    }


def _quality_figures(calibration: Calibration) -> list[tuple[str, str, str]]:
    noise = calibration.noise
    return [
        _pure_error(calibration),
        (
            Message("Noise of one dwell"),
            format_number(noise.used_v, "V"),
            Message(
                "what the uncertainties rest on: {basis}; {freedom} degrees of freedom",
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
        "scatter of one dwell mean between repeats of its pose; {freedom} degrees of freedom",
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
