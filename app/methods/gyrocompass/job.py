"""The job of gyrocompassing, as the entry point group `tumble.jobs` names it."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tumble.app.available import Available
from tumble.app.job_part import JobPart
from tumble.app.measurement import Measurement
from tumble.app.methods.gyrocompass.analysed import GyrocompassAnalysed, GyrocompassTraced
from tumble.app.methods.gyrocompass.stand_part import STAND, GyrocompassStand
from tumble.app.methods.gyrocompass.uncertainty import uncertainty_of
from tumble.app.stand import LoadedStand, WrittenStand
from tumble.calibrations.core.propagation import TRIALS
from tumble.calibrations.core.provenance import Provenance
from tumble.calibrations.methods.gyrocompass.at_the_stand import declared_at, loop_at
from tumble.calibrations.methods.gyrocompass.loop import asked_next, close_gyrocompass_loop, declared_fit
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations, read_gyrocompass_table
from tumble.calibrations.methods.gyrocompass.probes import PROBES
from tumble.calibrations.tracing.experiments import Experiment

if TYPE_CHECKING:
    from tumble.app.methods.gyrocompass.expectation import Expectation
    from tumble.procedures.plan import Plan


@dataclass(frozen=True)
class GyrocompassJob:
    """Fits `JobPart`, `Promising` and `Renewing`."""

    experiments: frozenset[str] = frozenset(probe.programme for probe in PROBES if probe.comes_along)
    stand: GyrocompassStand = STAND

    def read_table(self, path: Path) -> GyrocompassObservations:
        """Read the table of a gyrocompass. Raises `TableError`."""
        return read_gyrocompass_table(path)

    def answered(self, rows: GyrocompassObservations) -> GyrocompassObservations:
        """The rows as they are: what is in doubt is asked once they are fitted."""
        return rows

    def fit(self, measurement: Measurement, origin: Provenance, trials: int | None) -> GyrocompassAnalysed:
        """Fit heading and drift. Raises `ValueError`, `InputError`."""
        declared = declared_fit(_rows(measurement), measurement.reference_temperature_degc)
        declared = declared_at(declared, uncertainty_of(measurement), TRIALS if trials is None else trials)
        return GyrocompassAnalysed(measurement=measurement, provenance=origin, declared=declared)

    def trace(self, analysed: GyrocompassAnalysed) -> GyrocompassTraced:
        """Close the loop."""
        measurement = analysed.measurement
        loop = close_gyrocompass_loop(_rows(measurement), measurement.reference_temperature_degc)
        loop = loop_at(loop, uncertainty_of(measurement))
        return GyrocompassTraced(**vars(analysed), loop=loop)

    def suggested(self, traced: GyrocompassTraced) -> tuple[Experiment, ...]:
        """What to measure next."""
        return asked_next(traced.loop).experiments

    def available(self, stand: LoadedStand, rows: GyrocompassObservations, attended: bool) -> Available:  # noqa: ARG002
        """Which programmes a stand can run; whether somebody leans the base is asked when it comes to that."""
        from tumble.app.methods.gyrocompass.experiments import available  # the engine comes with it

        return available(stand, rows)

    def renewed(self, left: Available, rows: GyrocompassObservations) -> Available:
        """The experiments that are left, on the base as it leans by now."""
        from tumble.app.methods.gyrocompass.experiments import renewed

        return renewed(left, rows)

    def promise(self, planned: "Plan", stand: WrittenStand) -> "Expectation | None":
        """How uncertain the heading will be, where the programme says how the gyro wanders."""
        from tumble.app.methods.gyrocompass.expectation import expectation  # the engine comes with it

        return expectation(planned, stand)


def _rows(measurement: Measurement) -> GyrocompassObservations:
    assert isinstance(measurement.observations, GyrocompassObservations), "its own table"
    return measurement.observations


JOB: Final[JobPart] = GyrocompassJob()
