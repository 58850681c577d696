"""Raw files analysed by the method that they are of: fitted, and what is left traced."""

from pathlib import Path

from tumble.app.analysed import Analysed, Traced
from tumble.app.jobs import find_job
from tumble.app.measurement import Measurement
from tumble.app.measurements import provenance
from tumble.procedures.errors import InputError


def fit(
    measurement: Measurement, serial_number: str = "", trials: int | None = None, folder: Path | None = None
) -> Analysed:
    """Analyse a raw file.

    Parameters
    ----------
    measurement
        The raw file.
    serial_number
        Of the unit, where the file does not say.
    trials
        Trials of the Monte Carlo check; None for as many as the method takes.
    folder
        Store in which the record will lie; paths are relative to it.

    Raises
    ------
    InputError
        The rows cannot be analysed.
    """
    origin = provenance(measurement, serial_number, folder)
    try:
        return find_job(measurement.method).fit(measurement, origin, trials)
    except ValueError as error:
        raise InputError(str(error)) from error


def trace(analysed: Analysed) -> Traced:
    """Close the loop on a raw file that was analysed, and say what to measure next."""
    part = find_job(analysed.measurement.method)
    traced = part.trace(analysed)
    return traced.planned(part.suggested(traced))
