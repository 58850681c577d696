"""What runs of a gyro platform say of their turntable, and how they are corrected by what is known of it."""

from collections.abc import Sequence
from dataclasses import dataclass

from tumble.app.methods.gyrocompass.analysed import GyrocompassTraced
from tumble.calibrations.methods.gyrocompass.loop import declared_fit
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations
from tumble.calibrations.methods.gyrocompass.stand import applying
from tumble.calibrations.methods.gyrocompass.stand.evidence import GyrocompassRun, validity_of
from tumble.calibrations.stand_records.corrections import Corrections
from tumble.calibrations.stand_records.record import StandRecord, Validity
from tumble.calibrations.stand_records.terms import Term


@dataclass(frozen=True)
class GyrocompassStandRun:
    """A run as far as its stand is concerned. Fits `tumble.app.job_part.StandRun`."""

    run: GyrocompassRun

    @property
    def terms(self) -> tuple[Term, ...]:
        """Errors of the turntable that the run tells apart."""
        return self.run.terms

    @property
    def highest_order(self) -> int:
        """None: an error of any shape is not sought."""
        return self.run.highest_order

    @property
    def objections(self) -> tuple[str, ...]:
        """Why nothing may be learned from the run."""
        return self.run.objections

    @property
    def doubts(self) -> tuple[str, ...]:
        """Of what the run does not tell whether it is the turntable's."""
        return self.run.doubts

    def estimate(self, terms: Sequence[Term]) -> Corrections:
        """What the run says of these terms."""
        return self.run.estimate(terms)

    def contradictions(self, record: StandRecord) -> Sequence[str]:
        """Where it contradicts the stand record that was applied to it."""
        return tuple(applying.contradictions(self.run, record))

    def validity(self, measured_at: str) -> Validity:
        """Over what it was measured."""
        return validity_of(self.run.loop.observations, measured_at)


@dataclass(frozen=True)
class GyrocompassStand:
    """Fits `tumble.app.job_part.StandPart`."""

    def correctable(self, rows: GyrocompassObservations) -> bool:
        """Whether the rows follow their positions: of what is asked about nothing is taken off."""
        return not declared_fit(rows).doubts

    def corrected(self, rows: GyrocompassObservations, record: StandRecord) -> GyrocompassObservations:
        """Rows corrected by a stand record."""
        return applying.corrected(rows, record)

    def validity(self, rows: GyrocompassObservations) -> Validity:
        """Over what rows were measured."""
        return validity_of(rows)

    def run(self, traced: GyrocompassTraced) -> GyrocompassStandRun | None:
        """A run as far as its stand is concerned; None where nothing was traced."""
        return None if traced.explained is None else GyrocompassStandRun(GyrocompassRun(loop=traced.loop))


STAND = GyrocompassStand()
