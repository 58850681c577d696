"""The triad among the methods that are run at a stand."""

from dataclasses import dataclass
from importlib.resources import files
from typing import TYPE_CHECKING, Final

from tumble.calibrations.methods.triad.observations import TriadObservations
from tumble.procedures.method import ProcedurePart
from tumble.procedures.methods.triad.positions import programme_of_list
from tumble.procedures.methods.triad.programme import TriadProgramme

if TYPE_CHECKING:
    from tumble.procedures.recording.recorded import Recording


@dataclass(frozen=True, kw_only=True)
class TriadProcedures:
    """The method as far as a stand is concerned."""

    name: str
    version: int
    procedure_part: ProcedurePart[TriadObservations]


def _table(recording: "Recording") -> TriadObservations:
    from tumble.procedures.methods.triad.observations import observations  # the MCAP library takes 0.1 s

    return observations(recording)


PROCEDURE_PART: Final = ProcedurePart(
    programme=TriadProgramme,
    shipped=files(__package__) / "programmes",
    rows=TriadObservations,
    table=_table,
    listed=programme_of_list,
    stand=files(__package__) / "stand.toml",
)

METHOD: Final = TriadProcedures(name="triad", version=1, procedure_part=PROCEDURE_PART)
