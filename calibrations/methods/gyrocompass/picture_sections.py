"""Pictures of a gyrocompass beside its values, and what else its rows say."""

from collections.abc import Iterator

from tumble.calibrations.core.quantities import format_concise, format_probability
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.gyrocompass.azimuth_channel import HOURS, NOT_MEASURED, heading_uncertainty_deg
from tumble.calibrations.methods.gyrocompass.loop import GyrocompassLoop
from tumble.calibrations.report.figure import Figure
from tumble.messages import Message


def picture_sections(loop: GyrocompassLoop) -> Iterator[Section]:
    """Heading circle, rate against azimuth, drift over time."""
    yield Section(
        title=Message("Heading circle"),
        figure=lambda: _circle(loop),
        caption=Message(
            "α0, counterclockwise from north, with its 95% interval (the heading is -α0); marks are the positions."
        ),
    )
    yield Section(
        title=Message("Rate against azimuth"),
        figure=lambda: _rate(loop),
        caption=Message(
            "Each dwell with the fit, a colour for each base; below what is left, before (circles) and with what was "
            "found (triangles)."
        ),
    )
    yield Section(
        title=Message("Drift"),
        figure=lambda: _drift(loop),
        caption=Message("Rate of each dwell less the earth rate by the fit; the line is the stated drift."),
    )


def checks(loop: GyrocompassLoop) -> Section:
    """Closure, the published formula, the azimuth channel and an azimuth mark, as far as the rows tell them."""
    return Section(title=Message("Checks"), lines=[*_closure(loop), *_baseline(loop), *_channel(loop), *_mark(loop)])


def if_as_declared(loop: GyrocompassLoop) -> Section:
    """Heading and drift in the noise that is declared, and whether the gyro is so; no lines where none is."""
    return Section(title=Message("In the declared noise"), lines=[*_in_declared_noise(loop)], brief=True)


def _in_declared_noise(loop: GyrocompassLoop) -> Iterator[str]:
    found = loop.in_declared_noise
    if found is None:
        return
    yield Message(
        "If the gyro is as declared, α0 = {alpha0} and the drift is {drift}, by its noise alone, without the stand.",
        alpha0=format_concise(found.values["alpha0"], found.standard_uncertainties["alpha0"], "°"),
        drift=format_concise(found.values["drift"], found.standard_uncertainties["drift"], "°/h"),
    )
    if found.contradicted:
        yield Message(
            "The gyro is not as declared: its rates scatter {ratio:.2g} times as much. Correct its noise.",
            ratio=found.scatter_ratio,
        )


def _closure(loop: GyrocompassLoop) -> Iterator[str]:
    if closure := loop.closure:
        yield Message(
            "Closure: the earth rate differs by {value} (relative) from what the latitude says (p = {p_value}).",
            value=format_concise(closure.value, closure.standard_uncertainty, ""),
            p_value=format_probability(closure.p_value),
        )


def _baseline(loop: GyrocompassLoop) -> Iterator[str]:
    if baseline := loop.baseline:
        yield Message(
            "By the formula for three positions ({positions}): α0 = {alpha0:.3f}°, drift {drift:.4f} °/h.",
            positions="/".join(f"{each:g}" for each in baseline.azimuths_deg),
            alpha0=baseline.alpha0_deg,
            drift=baseline.drift_deg_h,
        )


def _channel(loop: GyrocompassLoop) -> Iterator[str]:
    drift, u_deg = loop.azimuth_drift, loop.augmented.parameters["alpha0"].standard_uncertainty
    if drift is None:
        yield Message("Drift of the azimuth channel: withheld, {reason}.", reason=NOT_MEASURED)
        return
    yield Message(
        "Drift of the azimuth channel {value}; take it off in dead reckoning.",
        value=format_concise(drift.value_deg_h, drift.standard_uncertainty_deg_h, "°/h"),
    )
    if u_deg is not None:
        grown = heading_uncertainty_deg(HOURS[-1], u_deg, drift.standard_uncertainty_deg_h)
        yield Message(
            "After {hours:g} h the heading is uncertain by {grown:.2g}° (1σ), and by what the drift wanders.",
            hours=HOURS[-1],
            grown=grown,
        )


def _mark(loop: GyrocompassLoop) -> Iterator[str]:
    if mark := loop.mark:
        off = format_concise(mark.difference_deg, mark.standard_uncertainty_deg, "°")
        if mark.agrees:
            yield Message("The heading agrees with the azimuth mark: they differ by {off}.", off=off)
        else:
            yield Message(
                "The heading differs from the azimuth mark by {off}: something turns with the base, such as a "
                "g-sensitive drift or a magnetic field.",
                off=off,
            )


def _circle(loop: GyrocompassLoop) -> Figure:
    from tumble.calibrations.methods.gyrocompass import figures

    return figures.heading_circle(loop)


def _rate(loop: GyrocompassLoop) -> Figure:
    from tumble.calibrations.methods.gyrocompass import figures

    return figures.rate_figure(loop)


def _drift(loop: GyrocompassLoop) -> Figure:
    from tumble.calibrations.methods.gyrocompass import figures

    return figures.drift_figure(loop)
