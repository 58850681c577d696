"""How well the values of an accelerometer describe its rows, in words."""

from collections.abc import Collection, Iterator

from tumble.app.row_sentences import row_lines
from tumble.calibrations.core.quantities import format_number, format_probability
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.methods.dividing_head.significance import Kind, statements
from tumble.messages import Message


def in_short(calibration: Calibration) -> Iterator[str]:
    """One line, and the rows that were set aside where there are any."""
    observations = calibration.observations
    parts = [
        Message.counted(
            "{rows} of {count} row used",
            "{rows} of {count} rows used",
            rows=len(observations),
            count=observations.rows_read,
        ),
        *_lack_of_fit(calibration),
    ]
    if calibration.held_out_rms_v is not None:
        parts.append(Message("held-out error {size} rms", size=format_number(calibration.held_out_rms_v, "V")))
    yield Message.joined("; ", parts)
    if observations.set_aside:
        yield from list(row_lines(observations))[1:]


def details(calibration: Calibration, elsewhere: Collection[Kind] = ()) -> Iterator[str]:
    """Rows, noise and adequacy, then what the experiment supports, without what is said `elsewhere`."""
    yield from _adequacy(calibration)
    yield from (Message("- {text}", text=each.text) for each in statements(calibration) if each.kind not in elsewhere)


def _lack_of_fit(calibration: Calibration) -> Iterator[str]:
    if calibration.lack_of_fit_p is not None:
        probability = format_probability(calibration.lack_of_fit_p)
        yield Message(
            "lack of fit: p {probability}",
            probability=probability if probability.startswith("<") else f"= {probability}",
        )


def _adequacy(calibration: Calibration) -> Iterator[str]:
    noise = calibration.noise
    yield from row_lines(calibration.observations)
    if noise.pure_error_v is not None:
        yield Message(
            "pure error of a dwell: {size} ({degrees_of_freedom} dof)",
            size=format_number(noise.pure_error_v, "V"),
            degrees_of_freedom=noise.degrees_of_freedom,
        )
    used = format_number(noise.used_v, "V")
    yield Message(
        "uncertainties rest on the {basis}: {used} ({used_degrees_of_freedom} dof)",
        basis=noise.basis,
        used=used,
        used_degrees_of_freedom=noise.used_degrees_of_freedom,
    )
    yield Message("residual: {size} rms", size=format_number(calibration.residual_rms_v, "V"))
    if calibration.held_out_rms_v is not None:
        yield Message("held-out error: {size} rms", size=format_number(calibration.held_out_rms_v, "V"))
    yield from _lack_of_fit(calibration)
    if calibration.closure and calibration.closure.worst:
        first, second, difference, sigmas = calibration.closure.worst
        size = Message(
            "{size}, {sigmas:.1f} standard uncertainties",
            size=format_number(abs(difference), "V", 2),
            sigmas=sigmas,
        )
        yield Message(
            "flip closure: u0 of the {first} and {second} flips differ by {size}", first=first, second=second, size=size
        )
