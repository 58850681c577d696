"""The job of vibration rectification, as the entry point group `tumble.jobs` names it."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tumble.app.available import Available
from tumble.app.job_part import JobPart
from tumble.app.measurement import Measurement
from tumble.app.methods.vibration.analysed import VibrationAnalysed, VibrationTraced
from tumble.app.methods.vibration.uncertainty import uncertainty_of
from tumble.app.stand import LoadedStand, WrittenStand
from tumble.calibrations.core.provenance import Provenance
from tumble.calibrations.methods.vibration.at_the_stand import declared_at, loop_at
from tumble.calibrations.methods.vibration.loop import asked_next, close_vibration_loop, declared_fit
from tumble.calibrations.methods.vibration.observations import VibrationObservations, read_vibration_table
from tumble.calibrations.methods.vibration.probes import PROBES
from tumble.calibrations.tracing.experiments import Experiment

if TYPE_CHECKING:
    from tumble.app.methods.vibration.promise import VibrationPromise
    from tumble.procedures.plan import Plan


@dataclass(frozen=True)
class VibrationJob:
    """Fits `JobPart` and `Promising`."""

    experiments: frozenset[str] = frozenset(probe.programme for probe in PROBES)
    stand: None = None

    def read_table(self, path: Path) -> VibrationObservations:
        """Read a table of dwells at rest and under vibration. Raises `TableError`."""
        return read_vibration_table(path)

    def answered(self, rows: VibrationObservations) -> VibrationObservations:
        """The rows as they are."""
        return rows

    def fit(self, measurement: Measurement, origin: Provenance, trials: int | None) -> VibrationAnalysed:  # noqa: ARG002
        """Fit the declared model; it is linear, so that no simulation checks it. Raises `ValueError`, `InputError`."""
        declared = declared_fit(_rows(measurement), measurement.reference_temperature_degc)
        declared = declared_at(declared, uncertainty_of(measurement))
        return VibrationAnalysed(measurement=measurement, provenance=origin, declared=declared)

    def trace(self, analysed: VibrationAnalysed) -> VibrationTraced:
        """Close the loop."""
        measurement = analysed.measurement
        loop = close_vibration_loop(_rows(measurement), measurement.reference_temperature_degc)
        loop = loop_at(loop, uncertainty_of(measurement))
        return VibrationTraced(**vars(analysed), loop=loop)

    def promise(self, planned: "Plan", stand: WrittenStand) -> "VibrationPromise | None":
        """What a plan can tell; None where nothing shakes in it."""
        from tumble.app.methods.vibration.promise import promise  # the programmes come with it

        return promise(planned, stand)

    def suggested(self, traced: VibrationTraced) -> tuple[Experiment, ...]:
        """What to measure next, of all programmes that come along."""
        return asked_next(traced.loop).experiments

    def available(self, stand: LoadedStand, rows: VibrationObservations, attended: bool) -> Available:  # noqa: ARG002
        """Which programmes a stand can run; a mounting that it asks for takes a person."""
        from tumble.app.methods.vibration.experiments import available  # the engine comes with it

        return available(stand) if attended else Available(offers=(), refused={})


def _rows(measurement: Measurement) -> VibrationObservations:
    assert isinstance(measurement.observations, VibrationObservations), "its own table"
    return measurement.observations


JOB: Final[JobPart] = VibrationJob()
