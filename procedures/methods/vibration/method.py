"""Vibration rectification among the methods that are run at a stand."""

from dataclasses import dataclass
from importlib.resources import files
from typing import TYPE_CHECKING, Final

from tumble.calibrations.methods.vibration.observations import VibrationObservations
from tumble.procedures.method import ProcedurePart
from tumble.procedures.methods.vibration.programme import VibrationProgramme

if TYPE_CHECKING:
    from tumble.procedures.recording.recorded import Recording


@dataclass(frozen=True, kw_only=True)
class VibrationProcedures:
    """The method as far as a stand is concerned."""

    name: str
    version: int
    procedure_part: ProcedurePart[VibrationObservations]


def _table(recording: "Recording") -> VibrationObservations:
    from tumble.procedures.methods.vibration.observations import observations  # the MCAP library takes 0.1 s

    return observations(recording)


PROCEDURE_PART: Final = ProcedurePart(
    programme=VibrationProgramme,
    shipped=files(__package__) / "programmes",
    rows=VibrationObservations,
    derived=frozenset(VibrationObservations.columns()),
    table=_table,
    stand=files(__package__) / "stand.toml",
)

METHOD: Final = VibrationProcedures(name="vibration", version=1, procedure_part=PROCEDURE_PART)
