"""Probes: short programmes that visit a unit in a way in which a table may not have seen it.

Each corresponds to a programme `probe-….toml` that comes along: one sweep, as a rule of 80 steps of 5°, shorter
where the head does not go so far.
"""

from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.joining import appended
from tumble.calibrations.core.surroundings import typical_course
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.messages import Message

STEP_DEG = 5.0
_FEWEST_DWELLS = 18
"""A quarter of a turn: less shows hardly anything."""
_RECENT = 20
"""So many of the last rows say what the temperature is now."""


@dataclass(frozen=True, kw_only=True)
class Probe:
    """A sweep in one mount, as often as there are realisations."""

    programme: str
    """Name of the programme that comes along."""
    does: Message
    """What it changes, to stand after its name."""
    mount: str = "face-up"
    order: Literal["up", "there-and-back", "shuffled"] = "up"
    realisations: int = 1
    warmer_k: float = 0.0
    """By how much the unit shall be warmer than at the end of the table, in kelvin."""
    wait_s: float = 0.0
    """Time until it is, or that is to pass."""
    start_deg: float = 0.0
    points: int = 80
    step_deg: float = STEP_DEG
    mounting_s: float = 60.0
    """Time in which an operator seats the unit; every run begins with it."""
    speed_deg_s: float = 20.0
    dwell_s: float = 1.5
    """Time to settle and to acquire."""

    def between(self, lowest_deg: float, highest_deg: float) -> "Probe | None":
        """The same where the head goes no further than so: as much of it as there is room for, None for too little."""
        if lowest_deg <= self.start_deg and self.start_deg + self.step_deg * (self.points - 1) <= highest_deg:
            return self
        start_deg = float(np.ceil(lowest_deg / self.step_deg)) * self.step_deg
        points = min(self.points, int((highest_deg - start_deg) // self.step_deg) + 1)
        return replace(self, start_deg=start_deg, points=points) if points >= _FEWEST_DWELLS else None

    @property
    def angles_deg(self) -> FloatArray:
        """Head angles in the order in which they are taken, shape (realisations, dwells)."""
        return np.array([self._angles_deg(number) for number in range(1, self.realisations + 1)])

    def _angles_deg(self, realisation: int) -> FloatArray:
        up: FloatArray = self.start_deg + self.step_deg * np.arange(self.points, dtype=np.float64)
        match self.order:
            case "up":
                return up
            case "there-and-back":
                return np.concatenate([up, up[-2::-1]])
            case "shuffled":
                return np.asarray(up[np.random.default_rng(realisation).permutation(len(up))])

    def step_s(self, start_deg: float = 0.0) -> FloatArray:
        """Time from each dwell to the next, shape (rows,); the first waits, and seats the unit."""
        moves_deg = np.diff(self.angles_deg.ravel(), prepend=start_deg)
        steps_s = np.abs(moves_deg) / self.speed_deg_s + self.dwell_s
        steps_s[0] += self.wait_s + self.mounting_s
        return np.asarray(steps_s, dtype=np.float64)

    @property
    def stand_time_s(self) -> float:
        """Time that it takes, the mounting and any wait included."""
        return float(self.step_s().sum())

    @property
    def command(self) -> str:
        """What to type to run it."""
        return f"tumble run --programme {self.programme} --serial SERIAL"

    @property
    def pairs(self) -> bool:
        """Whether it may help together with another: where it changes the mount."""
        return self.mount != "face-up"

    def after(self, rows: Observations) -> Observations:
        """Return a table with the rows that it would add, in a run and realisations of their own.

        Times and directions follow from the probe, and the head rests in every dwell. The temperature goes on as is
        typical after what it did: that it will stay where it is is no promise. Any other column, the output too, goes
        on with its last value. A column that the table lacks stays away, but for mount and realisation.
        """
        return appended(rows, _rows_of(self, rows))


PROBES = (
    Probe(
        programme="probe-repeat",
        does=Message("visits the same poses again, at the temperature as it is now"),
        realisations=3,
    ),
    Probe(
        programme="probe-back",
        does=Message("visits every pose from both sides"),
        order="there-and-back",
        realisations=2,
    ),
    Probe(
        programme="probe-face-down",
        does=Message("turns Oy over and leaves Ox and the head as they are"),
        mount="face-down",
        realisations=3,
    ),
    Probe(
        programme="probe-face-up-90",
        does=Message("turns Ox by 90° on the head, so that errors of the head fall on other values of ax"),
        mount="face-up-90",
        realisations=3,
    ),
    Probe(
        programme="probe-edge",
        does=Message("puts Oz in the place of Oy"),
        mount="edge",
        realisations=3,
    ),
    Probe(
        programme="probe-edge-back",
        does=Message("puts Oz in the place of Oy, turned over"),
        mount="edge-back",
        realisations=3,
    ),
    Probe(
        programme="probe-end",
        does=Message("takes ax away and leaves ay and az"),
        mount="end",
        realisations=3,
    ),
    Probe(
        programme="probe-shuffled",
        does=Message("takes the angles in no order, so that neither time nor the dwell before goes with them"),
        order="shuffled",
    ),
    Probe(
        programme="probe-slow",
        does=Message("dwells five times as long, so that what follows the time does not follow the number of dwells"),
        dwell_s=5.5,
    ),
    Probe(
        programme="probe-turns",
        does=Message("goes round twice, so that what comes back with the circle parts from what does not"),
        step_deg=9.0,
        order="there-and-back",
    ),
    Probe(
        programme="probe-later",
        does=Message("visits the same poses again, two hours later"),
        realisations=3,
        wait_s=7200.0,
    ),
    Probe(
        programme="probe-warm",
        does=Message("visits the same poses with the unit 10 K warmer"),
        realisations=3,
        warmer_k=10.0,
        wait_s=1800.0,
    ),
)
"""All probes. Of two that promise the same, the first is proposed."""


def _rows_of(probe: Probe, before: Observations) -> Observations:
    """Rows of a probe that is run after a table."""
    angle_deg = probe.angles_deg.ravel()
    rows, start_deg = len(angle_deg), float(before.angle_deg[-1])
    columns: dict[str, Any] = {
        "row": np.arange(1, rows + 1),
        "angle_deg": angle_deg,
        "realisation": np.repeat(np.arange(1, probe.realisations + 1), rows // probe.realisations),
        "mount": np.full(rows, probe.mount),
        "run": None,
    }
    if before.time_s is not None:
        columns["time_s"] = before.time_s[-1] + np.cumsum(probe.step_s(start_deg))
    if before.direction is not None:
        columns["direction"] = _directions(angle_deg, start_deg)
    if before.temperature_degc is not None:
        columns["temperature_degc"] = _going_on(before, columns["time_s"], rows) + probe.warmer_k
    if before.velocity_deg_s is not None:
        columns["velocity_deg_s"] = np.zeros(rows)
    return replace(before.lasting(rows), **columns)


def _directions(angle_deg: FloatArray, start_deg: float) -> FloatArray:
    """Sign of the last move that was one."""
    sign = np.sign(np.diff(angle_deg, prepend=start_deg)).astype(np.int64)
    last = np.maximum.accumulate(np.where(sign != 0, np.arange(len(sign)), 0))
    return np.asarray(sign[last])


def _going_on(before: Observations, time_s: FloatArray | None, rows: int) -> FloatArray:
    """Temperature of further rows: the mean of the last ones, or a course that is typical after that of the table."""
    assert before.temperature_degc is not None
    known = np.isfinite(before.temperature_degc)
    measured_degc = before.temperature_degc[known]
    if before.time_s is None or time_s is None or len(measured_degc) < 2 * _RECENT or not np.ptp(before.time_s[known]):
        return np.full(rows, np.mean(measured_degc[-_RECENT:]) if len(measured_degc) else np.nan)
    return typical_course(before.time_s[known], measured_degc, time_s)
