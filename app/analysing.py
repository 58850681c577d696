"""A raw file analysed: fitted, and what is left traced."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from app.measurements import Measurement, check_limits, provenance
from calibrations.analysis import analyse
from calibrations.montecarlo import TRIALS
from calibrations.provenance import LimitCheck, Provenance
from calibrations.result import Calibration
from calibrations.tracing.document import result_document
from calibrations.tracing.loop import Explained, Loop, asked_next, explain
from calibrations.tracing.questions import questioned
from procedures.errors import InputError


@dataclass(frozen=True, kw_only=True)
class Analysed:
    """A raw file and what the analysis says of it."""

    measurement: Measurement
    calibration: Calibration
    provenance: Provenance
    limits: tuple[LimitCheck, ...]

    @property
    def inside(self) -> bool:
        """Whether every limited parameter lies inside its limits."""
        return all(check.inside for check in self.limits)


@dataclass(frozen=True, kw_only=True)
class Traced(Analysed):
    """The same with the loop closed: what the residual was traced to, and what that does to the parameters."""

    loop: Loop
    explained: Explained | None
    """What the loop rests on; None where nothing was traced."""

    def as_json(self) -> dict[str, Any]:
        """The result as `tumble.fit/1`, with the closed loop (`tumble.loop/1`) under `loop`."""
        return result_document(self.calibration, self.loop)


def fit(
    measurement: Measurement, serial_number: str = "", trials: int = TRIALS, folder: Path | None = None
) -> Analysed:
    """Analyse a raw file.

    Parameters
    ----------
    measurement
        The raw file.
    serial_number
        Of the unit, where the file does not say.
    trials
        Trials of the Monte Carlo check.
    folder
        Store in which the record will lie; paths are relative to it.

    Raises
    ------
    InputError
        The rows cannot be analysed.
    """
    asked = questioned(measurement.observations, measurement.reference_temperature_degc)
    measurement = replace(measurement, observations=asked.observations)
    try:
        calibration = analyse(measurement.observations, measurement.uncertainty, trials)
    except ValueError as error:
        raise InputError(str(error)) from error
    return Analysed(
        measurement=measurement,
        calibration=calibration,
        provenance=provenance(measurement, serial_number, folder),
        limits=check_limits(calibration, measurement.programme),
    )


def trace(analysed: Analysed) -> Traced:
    """Close the loop on a raw file that was analysed."""
    measurement = analysed.measurement
    loop, explained = explain(measurement.observations, measurement.uncertainty, measurement.reference_temperature_degc)
    return Traced(**vars(analysed), loop=asked_next(loop, explained), explained=explained)
