"""A further method, which exists in these tests alone, at the stand: a lever whose load goes with the sine of an angle.

Its output is declared to be `u0 + k sin φ`. It may drift with time, or its bearing may twist with the angle: of one
sweep, in which both go up together, nobody can say which. One experiment tells them apart, a sweep there and back.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Literal

import numpy as np
from pydantic import BaseModel

from tumble.calibrations.core.joining import appended
from tumble.calibrations.core.rows import Rows, column
from tumble.calibrations.core.screening import without_missing
from tumble.calibrations.tracing.declared import Linear
from tumble.calibrations.tracing.effect import Effect, plain, single
from tumble.calibrations.tracing.noise import Memory
from tumble.calibrations.tracing.table import Extensible
from tumble.drivers.protocols import VOLTAGE
from tumble.drivers.tables import HEAD
from tumble.procedures.layout import ChannelColumns, Column, Layout, PositionColumns
from tumble.procedures.method import ProcedurePart
from tumble.procedures.programme import Programme
from tumble.procedures.recording.endings import warnings
from tumble.procedures.steps import Dwell

NAME, VERSION = "lever", 3
UNITS = {"u0": "V", "k": "V"}
STEP_DEG, POINTS, STEP_S = 5.0, 60, 1.5


@dataclass(frozen=True, kw_only=True)
class LeverRows(Rows):
    settings: ClassVar = ("lever_deg",)
    outputs: ClassVar = ("load_V",)

    lever_deg: np.ndarray = column("lever_deg", needed=True, required=True)
    load_v: np.ndarray | None = column("load_V", needed=True)


# what it is at the stand

LAYOUT = Layout(
    positions={
        HEAD: PositionColumns(
            position_deg=Column(name="lever_deg", meaning="angle of the lever, deg"),
            direction=Column(name="direction", meaning="sign of the last move"),
        )
    },
    channels={
        VOLTAGE: ChannelColumns(
            mean=Column(name="load_v", meaning="mean output, V"),
            sd=Column(name="load_sd_v", meaning="standard deviation of the single samples, V"),
            samples=Column(name="samples", meaning="number of samples in the mean"),
        )
    },
    conditions={},
)


class LeverSweep(BaseModel):
    step_deg: float
    points: int
    back: bool = False

    def dwells(self, realisation):
        up = [self.step_deg * number for number in range(self.points)]
        for angle_deg in [*up, *(up[-2::-1] if self.back else ())]:
            targets = {HEAD: angle_deg}
            yield Dwell(
                targets_deg=targets, channels=(VOLTAGE,), procedure="sweep", realisation=realisation, conditions={}
            )


class LeverProgramme(Programme):
    layout: ClassVar[Layout] = LAYOUT

    method: Literal["lever"]
    sweep: LeverSweep

    @property
    def parts(self):
        return (self.sweep,)

    def nominal(self, dwell):
        return {VOLTAGE: float(np.sin(np.deg2rad(dwell.targets_deg[HEAD])))}


def table_of(recording):
    points = recording.points
    return LeverRows(
        row=np.arange(1, len(points) + 1),
        time_s=np.array([point.time_s for point in points]),
        realisation=np.array([point.realisation for point in points], dtype=np.int64),
        lever_deg=np.array([point.positions_deg[HEAD] for point in points]),
        load_v=np.array([point.readings[VOLTAGE].mean for point in points]),
        take=recording.takes,
        warnings=tuple(warnings(recording)),
        complete=recording.complete,
        source=str(recording.path),
    )


@dataclass(frozen=True)
class LeverProcedures:
    name: str = NAME
    version: int = VERSION
    procedure_part: ProcedurePart = ProcedurePart(  # noqa: RUF009  # frozen
        programme=LeverProgramme, rows=LeverRows, shipped=Path(__file__).parent / "lever_programmes", table=table_of
    )


PROCEDURES = LeverProcedures()


# what its analysis sees


@dataclass(frozen=True, kw_only=True)
class LeverScene:
    lever_deg: np.ndarray
    time_h: np.ndarray
    hours: None = None

    @property
    def rows(self):
        return len(self.lever_deg)


EFFECTS = tuple(
    Effect(
        name=name,
        belongs_to="unit",
        symbol=name,
        source="what creeps or bends",
        forms=forms,
        report=plain(key, unit),
        depends_on="order",
    )
    for name, key, unit, forms in (
        ("drift", "drift_V_per_h", "V/h", lambda scene: single(scene.time_h)),
        ("twist", "twist_V_per_deg", "V/°", lambda scene: single(scene.lever_deg)),
    )
)


@dataclass(frozen=True, kw_only=True)
class LeverTable(Extensible):
    used: LeverRows

    @property
    def observations(self):
        return self.used

    def view(self, rows, theta):
        return scene_of(rows)

    def functions(self, view):
        return functions_of(view)


def scene_of(rows):
    return LeverScene(lever_deg=rows.lever_deg, time_h=rows.time_s / 3600.0)


def functions_of(scene):
    return np.column_stack([np.ones(scene.rows), np.sin(np.deg2rad(scene.lever_deg))])


def traceable(rows):
    scene = scene_of(rows)
    return LeverTable(
        used=rows,
        model=Linear(functions=functions_of(scene)),
        output=rows.load_v,
        unit="V",
        weights=np.ones(len(rows)),
        scene=scene,
        effects=EFFECTS,
        structures=(),
        memory=Memory(modes=np.empty((len(rows), 0))),
    )


@dataclass(frozen=True)
class ThereAndBack:
    """The experiment."""

    programme: str = "lever-back"
    does: str = "takes every angle from both sides"
    command: str = "tumble run --programme lever-back --serial SERIAL"
    pairs: bool = False

    @property
    def lever_deg(self):
        up = STEP_DEG * np.arange(POINTS)
        return np.concatenate([up, up[-2::-1]])

    @property
    def stand_time_s(self):
        return STEP_S * len(self.lever_deg)

    def after(self, rows: LeverRows) -> LeverRows:
        count = len(self.lever_deg)
        time_s = rows.time_s[-1] + STEP_S * np.arange(1, count + 1)
        added = LeverRows(
            row=np.arange(1, count + 1),
            time_s=time_s,
            lever_deg=self.lever_deg,
            load_v=np.full(count, rows.load_v[-1]),
        )
        return appended(rows, added)


def usable(rows: LeverRows) -> LeverRows:
    return without_missing(rows)


def reads(header: Sequence[str]) -> bool:
    return {"lever_deg", "load_V"} <= set(header)
