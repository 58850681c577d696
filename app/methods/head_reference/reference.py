"""A table of head and reference as far as a stand record is concerned, as the group `tumble.references` names it."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tumble.calibrations.methods.head_reference.head_map import ReferenceRun, reference_run
from tumble.calibrations.methods.head_reference.loop import close_reference_loop
from tumble.calibrations.methods.head_reference.observations import read_head_table
from tumble.calibrations.stand_records.corrections import Corrections
from tumble.calibrations.stand_records.record import Validity
from tumble.calibrations.stand_records.terms import Term


@dataclass(frozen=True, kw_only=True)
class HeadReferenceRun:
    """What a table says of its stand. Fits `tumble.app.referencing.ReferenceRun`."""

    run: ReferenceRun
    validity: Validity

    @property
    def whole(self) -> Corrections:
        """Harmonics of the circle and backlash."""
        return self.run.whole

    def estimate(self, terms: Sequence[Term]) -> Corrections:
        """What it says of these terms; of those that it does not have, nothing."""
        return self.run.estimate(terms)


def run_of(path: Path) -> HeadReferenceRun | None:
    """What a table says of its stand; None where it shows no error of the circle. Raises `TableError`, `ValueError`."""
    rows = read_head_table(path)
    found = reference_run(close_reference_loop(rows))
    if found is None:
        return None
    validity = Validity(angle_deg=(float(rows.angle_deg.min()), float(rows.angle_deg.max())))
    return HeadReferenceRun(run=found, validity=validity)
