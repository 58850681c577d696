"""The job of a triad, as the entry point group `tumble.jobs` names it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from tumble.app.available import Available
from tumble.app.job_part import JobPart
from tumble.app.measurement import Measurement
from tumble.app.methods.triad.analysed import TriadAnalysed, TriadTraced
from tumble.app.methods.triad.stand_part import STAND, TriadStand
from tumble.app.methods.triad.still import still_of
from tumble.app.methods.triad.uncertainty import uncertainty_of
from tumble.app.stand import LoadedStand
from tumble.calibrations.core.propagation import TRIALS
from tumble.calibrations.core.provenance import Provenance
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.triad.at_the_stand import declared_at, loop_at
from tumble.calibrations.methods.triad.by_temperature import parameter_runs
from tumble.calibrations.methods.triad.loop import asked_next, close_triad_loop, declared_fit
from tumble.calibrations.methods.triad.method import NEEDED
from tumble.calibrations.methods.triad.observations import TriadObservations, read_triad_table
from tumble.calibrations.methods.triad.picture_sections import position_section
from tumble.calibrations.methods.triad.probes import PROBES
from tumble.calibrations.tracing.experiments import Experiment


@dataclass(frozen=True)
class TriadJob:
    """Fits `JobPart`, `Pictured`, `OverTemperature`, and `SomeTables`: a log taken by hand is no run at a stand."""

    experiments: frozenset[str] = frozenset(probe.programme for probe in PROBES)
    stand: TriadStand = STAND

    def reads(self, header: Sequence[str]) -> bool:
        """Whether a table says where both axes stood."""
        return set(NEEDED) <= set(header)

    def read_table(self, path: Path) -> TriadObservations:
        """Read the table of a triad on two axes. Raises `TableError`."""
        return read_triad_table(path)

    def answered(self, rows: TriadObservations) -> TriadObservations:
        """The rows as they are: what is in doubt is asked once they are fitted."""
        return rows

    def fit(self, measurement: Measurement, origin: Provenance, trials: int | None) -> TriadAnalysed:
        """Fit the declared model. Raises `ValueError`, `InputError`."""
        declared = declared_fit(_rows(measurement), measurement.reference_temperature_degc)
        declared = declared_at(declared, uncertainty_of(measurement), TRIALS if trials is None else trials)
        return TriadAnalysed(measurement=measurement, provenance=origin, declared=declared)

    def trace(self, analysed: TriadAnalysed) -> TriadTraced:
        """Close the loop."""
        measurement = analysed.measurement
        loop = close_triad_loop(_rows(measurement), measurement.reference_temperature_degc)
        loop = loop_at(loop, uncertainty_of(measurement))
        return TriadTraced(**vars(analysed), loop=loop, still=still_of(measurement))

    def suggested(self, traced: TriadTraced) -> tuple[Experiment, ...]:
        """What to measure next, of all lists that come along."""
        return asked_next(traced.loop).experiments

    def available(self, stand: LoadedStand, rows: TriadObservations, attended: bool) -> Available:  # noqa: ARG002
        """Which lists of positions a stand can run; they need nobody."""
        from tumble.app.methods.triad.experiments import available  # the engine comes with it

        return available(stand, rows)

    def parameter_runs(self, tables: Sequence[TriadObservations]) -> Mapping[str, Sequence[float]]:
        """Parameters at each temperature. Raises `ValueError`."""
        return parameter_runs(tables)

    def pictures(self, targets_deg: Sequence[Mapping[str, float]]) -> Sequence[Section]:
        """Pictures of positions in their order."""
        positions = [(each["outer"], each["inner"]) for each in targets_deg]
        return (position_section(list(dict.fromkeys(positions))),)


def _rows(measurement: Measurement) -> TriadObservations:
    assert isinstance(measurement.observations, TriadObservations), "its own table"
    return measurement.observations


JOB: Final[JobPart] = TriadJob()
