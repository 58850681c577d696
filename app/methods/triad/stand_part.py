"""What runs of a triad say of their axes and voltmeter, and how they are corrected by what is known of these."""

from dataclasses import dataclass

from tumble.app.methods.triad.analysed import TriadTraced
from tumble.calibrations.methods.triad.loop import declared_fit
from tumble.calibrations.methods.triad.observations import TriadObservations
from tumble.calibrations.methods.triad.stand import applying
from tumble.calibrations.methods.triad.stand.evidence import TriadRun, validity_of
from tumble.calibrations.stand_records.record import StandRecord, Validity


@dataclass(frozen=True)
class TriadStand:
    """Fits `tumble.app.job_part.StandPart`."""

    def correctable(self, rows: TriadObservations) -> bool:
        """Whether the rows follow their positions: of what is asked about nothing is taken off."""
        return not declared_fit(rows).doubts

    def corrected(self, rows: TriadObservations, record: StandRecord) -> TriadObservations:
        """Rows corrected by a stand record."""
        return applying.corrected(rows, record)

    def validity(self, rows: TriadObservations) -> Validity:
        """Over what rows were measured."""
        return validity_of(rows)

    def run(self, traced: TriadTraced) -> TriadRun | None:
        """A run as far as its stand is concerned; None where nothing was traced."""
        return None if traced.explained is None else TriadRun(loop=traced.loop)


STAND = TriadStand()
