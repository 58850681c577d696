"""Probes: positions of the turntable, and leans of the base, in which a table may not have seen a platform."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.joining import appended
from tumble.calibrations.methods.gyrocompass.lean import Lean, leans
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations
from tumble.messages import Message

STEP_S: Final = 85.0
"""Time from dwell to dwell where neither a table nor a stand says it."""
_ANOTHER_LEAN: Final = (float(np.sin(np.deg2rad(-2.0))), float(np.sin(np.deg2rad(3.0))))
"""Sines of the tilts at pickoff angles 0 and 90° of a base that is made to lean."""


@dataclass(frozen=True, kw_only=True)
class GyrocompassProbe:
    """Positions in a run of their own."""

    programme: str
    """Name of the programme that comes along, or what is to be done."""
    does: Message
    """What it changes, to stand after its name."""
    azimuths_deg: tuple[float, ...]
    """In the order in which they are taken."""
    comes_along: bool = True
    """Whether there is such a programme."""
    leans: bool = False
    """Whether the base is made to lean otherwise before."""
    step_s: float = STEP_S
    """Time from dwell to dwell."""

    @property
    def stand_time_s(self) -> float:
        """Time that it takes."""
        return self.step_s * len(self.azimuths_deg)

    @property
    def command(self) -> str:
        """What to type to run it; empty where no programme comes along for it."""
        return f"tumble run --programme {self.programme} --serial SERIAL" if self.comes_along else ""

    @property
    def pairs(self) -> bool:
        """Each is planned by itself, or several times."""
        return False

    def after(self, rows: GyrocompassObservations) -> GyrocompassObservations:
        """A table with the dwells that it would add; what it says nothing of stays as it was last."""
        azimuth_deg = np.array(self.azimuths_deg)
        count = len(azimuth_deg)
        columns: dict[str, Any] = {"row": np.arange(1, count + 1), "azimuth_deg": azimuth_deg}
        if rows.direction is not None:
            columns["direction"] = _directions(azimuth_deg, float(rows.azimuth_deg[-1]))
        if rows.time_s is not None:
            columns["time_s"] = rows.time_s[-1] + self.step_s * np.arange(1, count + 1)
        if rows.realisation is not None:
            columns["realisation"] = np.full(count, rows.realisation.max() + 1)
        if rows.tilt_gamma_deg is not None:
            columns["tilt_gamma_deg"] = self._tilts_deg(rows, azimuth_deg)
            if self.leans:
                columns["base"] = np.full(count, 1 if rows.base is None else rows.base.max() + 1)
        return appended(rows, replace(rows.lasting(count), **columns))

    def _tilts_deg(self, rows: GyrocompassObservations, azimuth_deg: FloatArray) -> FloatArray:
        last = leans(rows).over(np.full(len(azimuth_deg), len(rows) - 1))
        if self.leans:
            cosine, sine = _ANOTHER_LEAN
            last = Lean(cosine=np.full(len(azimuth_deg), cosine), sine=np.full(len(azimuth_deg), sine))
        return np.rad2deg(np.arcsin(last.sin_tilt(np.deg2rad(azimuth_deg))))


def probes(step_s: float = STEP_S) -> tuple[GyrocompassProbe, ...]:
    """All of them, the shortest first, with the time from dwell to dwell."""
    return tuple(replace(probe, step_s=step_s) for probe in PROBES)


def usual_step_s(rows: GyrocompassObservations) -> float:
    """Time from dwell to dwell in a table."""
    if rows.time_s is None or len(rows) < 2:
        return STEP_S
    return max(float(np.median(np.diff(rows.time_s))), 1e-3)


def _directions(azimuth_deg: FloatArray, before_deg: float) -> NDArray[np.int64]:
    """Sign of the last move; it keeps its sign while the turntable stands."""
    step = np.sign(np.diff(azimuth_deg, prepend=before_deg)).astype(np.int64)
    last = np.maximum.accumulate(np.where(step != 0, np.arange(len(step)), 0))
    return np.asarray(np.where(step[last] != 0, step[last], 1))


def _back(azimuths_deg: Sequence[float]) -> tuple[float, ...]:
    return (*azimuths_deg, *reversed(azimuths_deg))


_FOUR: Final = (0.0, 90.0, 180.0, 270.0)
_TWELVE: Final = tuple(float(angle) for angle in range(0, 360, 30))

PROBES: Final = (
    GyrocompassProbe(
        programme="0-120-240",
        does=Message("takes three positions as far apart as can be"),
        azimuths_deg=(0.0, 120.0, 240.0),
    ),
    GyrocompassProbe(
        programme="0-180-90-270",
        does=Message("takes opposite positions one after the other, before the drift has changed"),
        azimuths_deg=(0.0, 180.0, 90.0, 270.0),
    ),
    GyrocompassProbe(
        programme="0-90-180-90-0",
        does=Message("goes there and back, so that time goes with no position, and each is taken from both sides"),
        azimuths_deg=(0.0, 90.0, 180.0, 90.0, 0.0),
    ),
    GyrocompassProbe(
        programme="another-lean",
        does=Message("lets the base lean by some degrees otherwise: what turns with the base then turns otherwise"),
        azimuths_deg=_back(_FOUR),
        leans=True,
    ),
    GyrocompassProbe(
        programme="every-30",
        does=Message("goes round in steps of 30° and back: errors of the pickoff are seen as what they are"),
        azimuths_deg=_back(_TWELVE),
    ),
)
"""The shortest first."""
