"""What runs of an accelerometer say of their dividing head, and how they are corrected by what is known of it."""

from collections.abc import Sequence
from dataclasses import dataclass

from tumble.app.methods.dividing_head.analysed import DividingHeadTraced
from tumble.app.methods.dividing_head.uncertainty import uncertainty_of
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.questions import questioned
from tumble.calibrations.methods.dividing_head.stand import applying, evidence
from tumble.calibrations.methods.dividing_head.stand.validity import validity_of
from tumble.calibrations.stand_records.contradicting import contradictions
from tumble.calibrations.stand_records.corrections import Corrections
from tumble.calibrations.stand_records.record import StandRecord, Validity
from tumble.calibrations.stand_records.terms import Term


@dataclass(frozen=True)
class DividingHeadRun:
    """A run as far as its stand is concerned. Fits `tumble.app.job_part.StandRun`."""

    run: evidence.Run

    @property
    def terms(self) -> tuple[Term, ...]:
        """Effects of the stand that the run tells apart."""
        return self.run.terms

    @property
    def highest_order(self) -> int:
        """Harmonics of the head that its settings can tell apart."""
        return self.run.highest_order

    @property
    def objections(self) -> tuple[str, ...]:
        """Why nothing may be learned from the run."""
        return self.run.objections

    @property
    def doubts(self) -> tuple[str, ...]:
        """Of what the run does not tell whether it is the stand's."""
        return tuple(evidence.doubts(self.run))

    def estimate(self, terms: Sequence[Term]) -> Corrections:
        """What the run says of these terms."""
        return self.run.estimate(terms)

    def contradictions(self, record: StandRecord) -> Sequence[str]:
        """Where it contradicts the stand record that was applied to it."""
        return tuple(contradictions(self.run, record))

    def validity(self, measured_at: str) -> Validity:
        """Over what it was measured."""
        return validity_of(self.run.loop.augmented.observations, measured_at)


@dataclass(frozen=True)
class DividingHeadStand:
    """Fits `tumble.app.job_part.StandPart`."""

    def correctable(self, rows: Observations) -> bool:
        """Whether there is an output: a table of head and reference is not corrected."""
        return rows.voltage_v is not None

    def corrected(self, rows: Observations, record: StandRecord) -> Observations:
        """Rows corrected by a stand record, repeats numbered."""
        return applying.corrected(questioned(rows).observations, record)

    def validity(self, rows: Observations) -> Validity:
        """Over what rows were measured."""
        return validity_of(rows)

    def run(self, traced: DividingHeadTraced) -> DividingHeadRun | None:
        """A run as far as its stand is concerned; None where nothing was traced."""
        if traced.explained is None:
            return None
        uncertainty = uncertainty_of(traced.measurement)
        return DividingHeadRun(evidence.Run(loop=traced.loop, explained=traced.explained, uncertainty=uncertainty))


STAND = DividingHeadStand()
