"""Gyrocompassing among the methods that are run at a stand."""

from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from typing import TYPE_CHECKING, Any, Final

from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations
from tumble.procedures.method import ProcedurePart
from tumble.procedures.methods.gyrocompass.layout import AZIMUTH_RATE
from tumble.procedures.methods.gyrocompass.positions import programme_of_list
from tumble.procedures.methods.gyrocompass.programme import GyrocompassProgramme, NoiseTable

if TYPE_CHECKING:
    from tumble.procedures.recording.recorded import Recording


@dataclass(frozen=True, kw_only=True)
class GyrocompassProcedures:
    """The method as far as a stand is concerned."""

    name: str
    version: int
    procedure_part: ProcedurePart[GyrocompassObservations]


def _table(recording: "Recording") -> GyrocompassObservations:
    from tumble.procedures.methods.gyrocompass.observations import observations  # the MCAP library takes 0.1 s

    return observations(recording)


def _demand(stand: Mapping[str, Any]) -> None:
    from tumble.procedures.methods.gyrocompass.observations import demand_latitude

    demand_latitude(stand)


PROCEDURE_PART: Final = ProcedurePart(
    programme=GyrocompassProgramme,
    shipped=files(__package__) / "programmes",
    rows=GyrocompassObservations,
    table=_table,
    derived=frozenset({"latitude_deg", "dwell_s", "rate_deg_h"}),
    lacking=frozenset({AZIMUTH_RATE, *NoiseTable.model_fields}),
    demand=_demand,
    listed=programme_of_list,
    stand=files(__package__) / "stand.toml",
)

METHOD: Final = GyrocompassProcedures(name="gyrocompass", version=1, procedure_part=PROCEDURE_PART)
