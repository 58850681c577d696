"""What runs of a gyro platform say of their turntable, and how they are corrected by what is known of it."""

from dataclasses import dataclass

from tumble.app.methods.gyrocompass.analysed import GyrocompassTraced
from tumble.calibrations.methods.gyrocompass.loop import declared_fit
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations
from tumble.calibrations.methods.gyrocompass.stand import applying
from tumble.calibrations.methods.gyrocompass.stand.evidence import GyrocompassRun, validity_of
from tumble.calibrations.stand_records.record import StandRecord, Validity


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

    def run(self, traced: GyrocompassTraced) -> GyrocompassRun | None:
        """A run as far as its stand is concerned; None where nothing was traced."""
        return None if traced.explained is None else GyrocompassRun(loop=traced.loop)


STAND = GyrocompassStand()
