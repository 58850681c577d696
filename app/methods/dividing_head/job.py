"""The job of an accelerometer, as the entry point group `tumble.jobs` names it."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

from tumble.app.available import Available
from tumble.app.job_part import JobPart
from tumble.app.measurement import Measurement
from tumble.app.measurements import check_limits
from tumble.app.methods.dividing_head.analysed import DividingHeadAnalysed, DividingHeadTraced, traced_with
from tumble.app.methods.dividing_head.stand_part import STAND, DividingHeadStand
from tumble.app.methods.dividing_head.uncertainty import uncertainty_of
from tumble.app.stand import LoadedStand
from tumble.calibrations.adopted.offered import Adopting, offered
from tumble.calibrations.core.propagation import TRIALS
from tumble.calibrations.core.provenance import Provenance
from tumble.calibrations.methods.dividing_head.analysis import analyse
from tumble.calibrations.methods.dividing_head.effects.adopting import ADOPTING
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.methods.dividing_head.loop.loop import asked_next, explain_questioned
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.probes import PROBES
from tumble.calibrations.methods.dividing_head.questions import questioned
from tumble.calibrations.methods.dividing_head.table import read_table
from tumble.calibrations.tracing.experiments import Experiment


@dataclass(frozen=True)
class DividingHeadJob:
    """Fits `tumble.app.job_part.JobPart`."""

    experiments: frozenset[str] = frozenset(probe.programme for probe in PROBES)
    stand: DividingHeadStand = STAND
    adopting: Adopting[Scene] = ADOPTING

    def read_table(self, path: Path) -> Observations:
        """Read an observation table. Raises `TableError`."""
        return read_table(path)

    def answered(self, rows: Observations) -> Observations:
        """The rows, repeats numbered. Raises `ValueError`: a question that nothing can be traced without."""
        asked = questioned(rows)
        if not asked.answerable:
            raise ValueError(asked.questions[0])
        return asked.observations

    def fit(self, measurement: Measurement, origin: Provenance, trials: int | None) -> DividingHeadAnalysed:
        """Fit the declared model. Raises `ValueError`, `InputError`."""
        asked = questioned(_rows(measurement), measurement.reference_temperature_degc)
        calibration = analyse(asked.observations, uncertainty_of(measurement), TRIALS if trials is None else trials)
        return DividingHeadAnalysed(
            measurement=replace(measurement, observations=asked.observations),
            asked=asked,
            calibration=calibration,
            provenance=origin,
            limits=check_limits(calibration.parameters, measurement.programme),
        )

    def trace(self, analysed: DividingHeadAnalysed) -> DividingHeadTraced:
        """Close the loop."""
        measurement = analysed.measurement
        reference_degc = measurement.reference_temperature_degc
        adopted = [offered(each, self.adopting) for each in measurement.adopted]
        effects = [(*self.adopting.catalogue, *adopted)] if adopted else []
        loop, explained = explain_questioned(analysed.asked, uncertainty_of(measurement), reference_degc, *effects)
        return traced_with(analysed, loop, explained)

    def suggested(self, traced: DividingHeadTraced) -> tuple[Experiment, ...]:
        """What to measure next, of all probes, and how many more settings it takes."""
        return asked_next(traced.loop, traced.explained).next_experiment

    def available(self, stand: LoadedStand, rows: Observations, attended: bool) -> Available:
        """Which probes a stand can run."""
        from tumble.app.methods.dividing_head.experiments import available  # the engine comes with it

        return available(stand, rows, attended)


def _rows(measurement: Measurement) -> Observations:
    assert isinstance(measurement.observations, Observations), "its own table"
    return measurement.observations


JOB: Final[JobPart] = DividingHeadJob()
