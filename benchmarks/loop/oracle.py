"""A least-squares fit that knows which effects are there and in what form, and fits the unit and their amplitudes.

Everything that an effect's draw fixed besides its amplitude is known to it: phase, order, period, threshold, time
constant, form of a loop; of levels (realisation_bias, seating) and of a random walk the course that was drawn, with one
amplitude; of misreadings the rows and their errors. No analysis that sees the table alone can be asked for more.
"""

from dataclasses import astuple, dataclass

import numpy as np
from scipy.optimize import least_squares

from benchmarks.bank import Stage, Unit
from benchmarks.bank.dwells import IntArray
from benchmarks.bank.geometry import FloatArray
from benchmarks.bank.misreading import Misreading
from benchmarks.bank.scene import respond

PARAMETERS = ("u0", "kx", "ky", "kz", "kxy", "alpha0")
_STEPS = (1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-2)
"""Steps of the six parameters (V and g, degrees) in the central differences."""
_PART = 1e-3
"""Step of an amplitude, relative."""
_RANK = 1e-8
_LOST = 1e-12
"""Square of the part of a parameter along what cannot be told beyond which it cannot be told either."""
_FARTHEST_DEG = 45.0
_K95 = 1.96
_TIED = 3.0
"""By how much an unknown alpha0 must widen a parameter for it to be tied by alpha0."""


@dataclass(frozen=True, kw_only=True)
class Oracle:
    """What the oracle finds."""

    unit: Unit
    amplitudes: FloatArray
    """Of the effects that have one to be fitted, in their order."""
    fitted_v: FloatArray
    """Output of every row of the table, used or not."""
    unknown: tuple[str, ...]
    """Parameters that the table cannot tell even the oracle."""


def ask_oracle(stage: Stage, reading_v: FloatArray, used: IntArray, noise_v: float) -> Oracle:
    """Fit from the truth on, every step measured by what noise does to a parameter.

    Parameters
    ----------
    stage
        What is behind the table.
    reading_v
        The readings, shape (used rows,), in volts.
    used
        Numbers of the rows that they belong to, the first being 0.
    noise_v
        Standard deviation of a reading.
    """
    known = [pair for pair in stage.sized if isinstance(pair[0], Misreading)]
    free = [effect for effect, _ in stage.sized if not isinstance(effect, Misreading)]
    sizes = [amplitude for effect, amplitude in stage.sized if not isinstance(effect, Misreading)]

    def output_v(at: FloatArray) -> FloatArray:
        return respond(stage.run, Unit(**_by_name(at)), [*zip(free, at[6:].tolist(), strict=True), *known])

    steps = np.array([*_STEPS, *(_PART * abs(size) for size in sizes)])

    def jacobian(at: FloatArray) -> FloatArray:
        changes = [output_v(at + step) - output_v(at - step) for step in np.diag(steps)]
        return (np.stack(changes, axis=1) / (2.0 * steps))[used]

    truth = np.array([*astuple(stage.unit), *sizes])
    seen = jacobian(truth)
    lengths = np.linalg.norm(seen, axis=0)
    unit = noise_v / np.where(lengths > 0.0, lengths, 1.0)
    solved = least_squares(
        lambda moved: (output_v(truth + moved * unit)[used] - reading_v) / noise_v,
        np.zeros(len(truth)),
        jac=lambda moved: jacobian(truth + moved * unit) * unit / noise_v,
    )
    at = truth + solved.x * unit
    return Oracle(
        unit=Unit(**_by_name(at)),
        amplitudes=at[6:],
        fitted_v=output_v(at),
        unknown=_unknown(seen * unit / noise_v, unit, float(at[5])),
    )


def _by_name(at: FloatArray) -> dict[str, float]:
    return dict(zip(Unit.__dataclass_fields__, at[:6].tolist(), strict=True))


def _unknown(scaled: FloatArray, noise: FloatArray, alpha0_deg: float) -> tuple[str, ...]:
    """Parameters whose interval is unbounded, for alpha0 also one that reaches 45°, and those that alpha0 then ties."""
    deviations = _deviations(scaled) * noise
    unknown = [name for name, deviation in zip(PARAMETERS, deviations, strict=False) if not np.isfinite(deviation)]
    if not abs(alpha0_deg) + _K95 * deviations[5] < _FARTHEST_DEG:
        given = np.insert(_deviations(np.delete(scaled, 5, axis=1)), 5, 0.0) * noise
        tied = deviations[:6] > _TIED * given[:6]
        unknown += [name for name, is_tied in zip(PARAMETERS, tied, strict=True) if is_tied]
    return tuple(name for name in PARAMETERS if name in unknown)


def _deviations(scaled: FloatArray) -> FloatArray:
    """Standard deviations for unit noise, infinite for what the columns do not determine."""
    _, values, rows = np.linalg.svd(scaled, full_matrices=False)
    kept = values > _RANK * values[0]
    finite = np.sqrt(((rows[kept] / values[kept, None]) ** 2).sum(axis=0))
    lost = (rows[~kept] ** 2).sum(axis=0) > _LOST
    return np.where(lost | (np.linalg.norm(scaled, axis=0) < 0.5), np.inf, finite)
