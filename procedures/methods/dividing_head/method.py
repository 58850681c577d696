"""The dividing head among the methods."""

from collections.abc import Sequence
from dataclasses import dataclass
from importlib.resources import files
from typing import TYPE_CHECKING, Final

from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.procedures.method import ProcedurePart
from tumble.procedures.methods.dividing_head.programme import DividingHeadProgramme
from tumble.procedures.second_look import Contradiction
from tumble.procedures.steps import Point

if TYPE_CHECKING:
    from tumble.procedures.recording.recorded import Recording


@dataclass(frozen=True, kw_only=True)
class StandMethod:
    """A method as far as a stand is concerned."""

    name: str
    version: int
    procedure_part: ProcedurePart[Observations]


def _table(recording: "Recording") -> Observations:
    from tumble.procedures.methods.dividing_head.observations import observations  # the MCAP library takes 0.1 s

    return observations(recording)


def _contradicted(point: Point, points: Sequence[Point]) -> Contradiction | None:
    from tumble.procedures.methods.dividing_head.contradiction import contradiction  # only a head that is read by eye

    return contradiction(point, points)


PROCEDURE_PART: Final = ProcedurePart(
    programme=DividingHeadProgramme,
    shipped=files(__package__) / "programmes",
    rows=Observations,
    table=_table,
    contradicted=_contradicted,
)

METHOD: Final = StandMethod(name="dividing_head", version=1, procedure_part=PROCEDURE_PART)
