"""How well the values of an accelerometer describe its rows, in words."""

from collections.abc import Collection, Iterator

from tumble.app.row_sentences import row_lines
from tumble.calibrations.core.quantities import format_number, format_probability
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.methods.dividing_head.significance import Kind, statements


def in_short(calibration: Calibration) -> Iterator[str]:
    """One line, and the rows that were set aside where there are any."""
    observations = calibration.observations
    parts = [f"{len(observations)} of {observations.rows_read} rows used", *_lack_of_fit(calibration)]
    if calibration.held_out_rms_v is not None:
        parts.append(f"held-out error {format_number(calibration.held_out_rms_v, 'V')} rms")
    yield "; ".join(parts)
    if observations.set_aside:
        yield from list(row_lines(observations))[1:]


def details(calibration: Calibration, elsewhere: Collection[Kind] = ()) -> Iterator[str]:
    """Rows, noise and adequacy, then what the experiment supports, without what is said `elsewhere`."""
    yield from _adequacy(calibration)
    yield from (f"- {each.text}" for each in statements(calibration) if each.kind not in elsewhere)


def _lack_of_fit(calibration: Calibration) -> Iterator[str]:
    if calibration.lack_of_fit_p is not None:
        probability = format_probability(calibration.lack_of_fit_p)
        yield f"lack of fit: p {probability if probability.startswith('<') else f'= {probability}'}"


def _adequacy(calibration: Calibration) -> Iterator[str]:
    noise = calibration.noise
    yield from row_lines(calibration.observations)
    if noise.pure_error_v is not None:
        yield f"pure error of a dwell: {format_number(noise.pure_error_v, 'V')} ({noise.degrees_of_freedom} dof)"
    used = format_number(noise.used_v, "V")
    yield f"uncertainties rest on the {noise.basis}: {used} ({noise.used_degrees_of_freedom} dof)"
    yield f"residual: {format_number(calibration.residual_rms_v, 'V')} rms"
    if calibration.held_out_rms_v is not None:
        yield f"held-out error: {format_number(calibration.held_out_rms_v, 'V')} rms"
    yield from _lack_of_fit(calibration)
    if calibration.closure and calibration.closure.worst:
        first, second, difference, sigmas = calibration.closure.worst
        size = f"{format_number(abs(difference), 'V', 2)}, {sigmas:.1f} standard uncertainties"
        yield f"flip closure: u0 of the {first} and {second} flips differ by {size}"
