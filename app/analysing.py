"""A raw file analysed: fitted, and what is left traced."""

from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

from tumble.app.measurements import Measurement, check_limits, provenance
from tumble.calibrations.core.provenance import LimitCheck, Provenance
from tumble.calibrations.core.verdict import Verdict
from tumble.calibrations.methods.dividing_head.analysis import analyse
from tumble.calibrations.methods.dividing_head.document import document, result_document
from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.methods.dividing_head.judging import judge
from tumble.calibrations.methods.dividing_head.loop.loop import Explained, Loop, asked_next, explain
from tumble.calibrations.methods.dividing_head.montecarlo import TRIALS
from tumble.calibrations.methods.dividing_head.questions import questioned
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.methods.dividing_head.usable import Usable, usable
from tumble.calibrations.records.entry import Entry
from tumble.procedures.errors import InputError


@dataclass(frozen=True, kw_only=True)
class Analysed:
    """A raw file and what the analysis says of it."""

    measurement: Measurement
    calibration: Calibration
    provenance: Provenance
    limits: tuple[LimitCheck, ...]
    """Of the values to use."""

    @property
    def usable(self) -> Usable:
        """The values to use."""
        return usable(self.calibration)

    @property
    def verdict(self) -> Verdict:
        """How the unit stands against the limits of its programme."""
        return judge(self.calibration, self.limits)

    @property
    def entry(self) -> Entry:
        """The result as the store takes it."""
        return entry(self.calibration, self.limits, verdict=self.verdict)

    def as_json(self) -> dict[str, Any]:
        """The result as `tumble.fit/1`, with the verdict."""
        return result_document(self.calibration, None, self.verdict)


@dataclass(frozen=True, kw_only=True)
class Traced(Analysed):
    """The same with the loop closed: what the residual was traced to, and what that does to the parameters."""

    loop: Loop
    explained: Explained | None
    """What the loop rests on; None where nothing was traced."""

    @cached_property
    def usable(self) -> Usable:
        """The values to use, by what the loop found."""
        return usable(self.calibration, self.loop)

    @cached_property
    def verdict(self) -> Verdict:
        """How the unit stands against the limits of its programme, by what the loop found."""
        return judge(self.calibration, self.limits, self.loop)

    @property
    def entry(self) -> Entry:
        """The result as the store takes it."""
        return entry(self.calibration, self.limits, self.loop, self.verdict)

    def as_json(self) -> dict[str, Any]:
        """The result as `tumble.fit/1`, with verdict and closed loop (`tumble.loop/1`) under `verdict` and `loop`."""
        return result_document(self.calibration, self.loop, self.verdict)

    def loop_json(self) -> dict[str, Any]:
        """The result as `tumble.loop/1`, with the verdict."""
        return document(self.loop, self.verdict)


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
        limits=check_limits(calibration.parameters, measurement.programme),
    )


def trace(analysed: Analysed) -> Traced:
    """Close the loop on a raw file that was analysed."""
    measurement = analysed.measurement
    loop, explained = explain(measurement.observations, measurement.uncertainty, measurement.reference_temperature_degc)
    return traced_with(analysed, asked_next(loop, explained), explained)


def traced_with(analysed: Analysed, loop: Loop, explained: Explained | None) -> Traced:
    """What was analysed, with a loop that was closed on it."""
    limits = check_limits(usable(analysed.calibration, loop).calibration.parameters, analysed.measurement.programme)
    return Traced(**{**vars(analysed), "limits": limits}, loop=loop, explained=explained)
