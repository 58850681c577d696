"""Probes: lists of positions that visit a triad in a way in which a table may not have seen it."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.joining import appended
from tumble.calibrations.methods.triad.observations import TriadObservations
from tumble.calibrations.methods.triad.programmes import POSITIONS, Position
from tumble.messages import Message

STEP_S = 175.0
"""Time from dwell to dwell where neither a table nor a stand says it."""


@dataclass(frozen=True, kw_only=True)
class TriadProbe:
    """A list of positions, in a run of its own."""

    programme: str
    """Name of the programme that comes along."""
    does: Message
    """What it changes, to stand after its name."""
    positions: tuple[Position, ...]
    """In the order in which they are taken."""
    step_s: float = STEP_S
    """Time from dwell to dwell."""

    @property
    def stand_time_s(self) -> float:
        """Time that it takes."""
        return self.step_s * len(self.positions)

    @property
    def command(self) -> str:
        """What to type to run it."""
        return f"tumble run --programme {self.programme} --serial SERIAL"

    @property
    def pairs(self) -> bool:
        """Each is planned by itself, or several times."""
        return False

    def after(self, rows: TriadObservations) -> TriadObservations:
        """A table with the dwells that it would add; what the positions say nothing of stays as it was last."""
        outer_deg, inner_deg = np.array(self.positions).T
        count = len(self.positions)
        columns: dict[str, Any] = {
            "row": np.arange(1, count + 1),
            "outer_deg": outer_deg,
            "inner_deg": inner_deg,
        }
        for name, angle_deg, said in (
            ("outer_direction", outer_deg, rows.outer_direction),
            ("inner_direction", inner_deg, rows.inner_direction),
        ):
            if said is not None:
                columns[name] = _directions(angle_deg)
        if rows.time_s is not None:
            columns["time_s"] = rows.time_s[-1] + self.step_s * np.arange(1, count + 1)
        if rows.realisation is not None:
            columns["realisation"] = np.ones(count, dtype=np.int64)
        return appended(rows, replace(rows.lasting(count), **columns))


def probes(step_s: float = STEP_S) -> tuple[TriadProbe, ...]:
    """All of them, the shortest first, with the time from dwell to dwell."""
    return tuple(replace(probe, step_s=step_s) for probe in PROBES)


def usual_step_s(rows: TriadObservations) -> float:
    """Time from dwell to dwell in a table."""
    if rows.time_s is None or len(rows) < 2:
        return STEP_S
    return max(float(np.median(np.diff(rows.time_s))), 1e-3)


def _directions(angle_deg: FloatArray) -> NDArray[np.int64]:
    """Sign of the last move of an axis, which stands at 0 before; it keeps its sign while the axis stands."""
    step = np.sign(np.diff(angle_deg, prepend=0.0)).astype(np.int64)
    last = np.maximum.accumulate(np.where(step != 0, np.arange(len(step)), 0))
    return np.asarray(step[last])


def _back(positions: Sequence[Position]) -> tuple[Position, ...]:
    return (*positions, *reversed(positions))


_AGAIN = Message("takes other positions in steps of 45°")
_BOTH_WAYS = Message(
    "takes the positions there and back, so that time goes with none of them, and each from both sides"
)

PROBES = (
    TriadProbe(programme="8o", does=_AGAIN, positions=POSITIONS["8o"]),
    TriadProbe(programme="12o", does=_AGAIN, positions=POSITIONS["12o"]),
    TriadProbe(programme="12", does=Message("takes the twelve edges"), positions=POSITIONS["12"]),
    TriadProbe(programme="16o", does=_AGAIN, positions=POSITIONS["16o"]),
    TriadProbe(
        programme="fine",
        does=Message("leaves the steps of 45°, so that each channel sees other sizes of input"),
        positions=POSITIONS["fine"],
    ),
    TriadProbe(programme="24", does=Message("takes all three circles"), positions=POSITIONS["24"]),
    TriadProbe(programme="18-there-and-back", does=_BOTH_WAYS, positions=_back(POSITIONS["18"])),
    TriadProbe(programme="24-there-and-back", does=_BOTH_WAYS, positions=_back(POSITIONS["24"])),
)
"""The shortest first."""
