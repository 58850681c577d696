"""Single gross errors of the angle: set wrong, so that the head stood elsewhere, or read wrong."""

from dataclasses import dataclass

import numpy as np

from benchmarks.bank.geometry import FloatArray
from benchmarks.bank.scene import AngleEffect, Value, respond
from benchmarks.bank.visibility import Sight

_AMOUNTS_DEG = (10.0 / 60.0, 20.0 / 60.0, 0.5, 1.0, 2.0, 5.0, 10.0)
_CLEARLY = 8.0
"""Noise units by which a misreading changes the voltage."""


@dataclass(frozen=True, kw_only=True)
class Misreading(AngleEffect):
    """Errors of some rows, true angle minus reported; the amplitude is 1."""

    reported_shift_deg: FloatArray
    """What the rows that were read wrong report, minus the angle of the head."""

    def coefficient(self, amplitude: float) -> dict[str, Value]:  # noqa: ARG002
        """Return the rows, the first being 1, and their errors."""
        return dict(self.others)


def drawn_misreading(seen: Sight, noise_v: float, rng: np.random.Generator) -> Misreading:
    """Draw 1 to 16 rows whose error is clearly visible."""
    rows = len(seen.run.dwells)
    order = rng.permutation(rows)
    error_deg = rng.choice(_AMOUNTS_DEG, rows) * rng.choice([-1.0, 1.0], rows)
    change_v = respond(seen.run, seen.unit, ((_offset(error_deg), 1.0),)) - seen.plain_v
    chosen = np.sort(order[np.abs(change_v[order]) > _CLEARLY * noise_v][: rng.integers(1, 17)])
    of_row = np.zeros(rows)
    of_row[chosen] = error_deg[chosen]
    set_deg = np.where(rng.uniform(size=rows) < 0.5, of_row, 0.0)
    return Misreading(
        name="misreading",
        shape="set or read",
        others={"rows": (chosen + 1).tolist(), "error_deg": error_deg[chosen].tolist()},
        error_deg=lambda _, amplitude: amplitude * set_deg,
        reported_shift_deg=set_deg - of_row,
    )


def _offset(error_deg: FloatArray) -> AngleEffect:
    return AngleEffect(name="misreading", error_deg=lambda _, amplitude: amplitude * error_deg)
