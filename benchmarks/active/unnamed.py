"""Units and heads with structure that no catalogue names, and the channel and variable on which each lives.

Every case is a physics file: along a variable, something is added to the declared response or to the angle of the head.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from benchmarks.active.cases import SWEEP, Case, Rng, drawn, made

FIRST: Final = 985_000
"""Among the seeds of the bank, beyond those of the cases with a name."""


@dataclass(frozen=True, kw_only=True)
class Kind:
    """What is added, as a formula of its variable."""

    added: str
    """Formula with SIZE, PLACE from 0 to 1 and SIGN."""
    to: str
    """response or head_error."""
    place: str
    """Channel and variable of the contract."""
    low: float
    high: float
    """Limits of its size, in volts or degrees."""


_BELL: Final = "exp(-0.5 * (({0}) / {1}) ** 2)"
_ROUND: Final = "(angle_deg - 360.0 * PLACE + 180.0) % 360.0 - 180.0"
KINDS: Final = {
    "bell in ax": Kind(added=_BELL.format("ax - 1.6 * PLACE + 0.8", 0.12), to="response", place="offset × acceleration",
                       low=4e-4, high=2e-3),
    "bell in ay": Kind(added=_BELL.format("ay - 1.6 * PLACE + 0.8", 0.12), to="response", place="offset × acceleration",
                       low=4e-4, high=2e-3),
    "bell in the angle": Kind(added=_BELL.format(_ROUND, 14.0), to="head_error", place="angle × angle",
                              low=0.04, high=0.2),
    "sector of the angle": Kind(added=f"(1.0 if abs({_ROUND}) < 25.0 else 0.0)", to="head_error", place="angle × angle",
                                low=0.04, high=0.2),
    "wave over all turns": Kind(added="sin(angle_deg / (30.0 + 60.0 * PLACE) + 6.0 * PLACE)", to="head_error",
                                place="angle × unwrapped_angle", low=0.04, high=0.2),
    "wave in time": Kind(added="sin(time_s * 6.2832 / (60.0 + 300.0 * PLACE))", to="response", place="offset × time",
                         low=4e-4, high=2e-3),
    "pulse in time": Kind(added="(1.0 if 60.0 < time_s - 300.0 * PLACE < 260.0 else 0.0)", to="response",
                          place="offset × time", low=4e-4, high=2e-3),
    "wave of the scale in time": Kind(added="ax * sin(time_s * 6.2832 / (60.0 + 300.0 * PLACE))", to="response",
                                      place="scale × time", low=4e-4, high=2e-3),
    "wave of the angle in time": Kind(added="sin(time_s * 6.2832 / (60.0 + 300.0 * PLACE))", to="head_error",
                                      place="angle × time", low=0.04, high=0.2),
}  # fmt: skip

_PROGRAMMES: Final = {
    "sweep": SWEEP.format("face-up", "up"),
    "there and back": SWEEP.format("face-up", "there-and-back"),
}
"""Short ones, in which angle, projection, time and order of the dwells go together."""


def make(seed: int) -> Case:
    """The case of a seed."""
    return made(seed, {name: _physics(kind) for name, kind in KINDS.items()}, _PROGRAMMES, realisations=(1, 2))


def _physics(kind: Kind) -> Callable[[Rng, dict[str, float]], tuple[str, str]]:
    def physics(rng: Rng, unit: dict[str, float]) -> tuple[str, str]:
        size = drawn(rng, kind.low, kind.high) * int(rng.choice([-1, 1]))
        place = float(rng.uniform(0.0, 1.0))
        head = f"from math import exp, sin\n\nSIZE, PLACE = {size!r}, {place!r}\n"
        if kind.to == "head_error":
            return kind.to, f"{head}\n\ndef head_error(angle_deg, direction, time_s):\n    return SIZE * {kind.added}\n"
        numbers = [float(unit[name]) for name in ("u0", "kx", "ky", "kz", "kxy")]
        return kind.to, (
            f"{head}U0, KX, KY, KZ, KXY = {numbers}\n\n\n"
            "def response(ax, ay, az, temperature_degc, time_s):\n"
            f"    return U0 + ax * (KX + KXY * ay) + KY * ay + KZ * az + SIZE * {kind.added}\n"
        )

    return physics
