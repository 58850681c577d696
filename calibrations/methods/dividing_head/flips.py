"""The 180° flips: where their poles are, and whether the x, y and z flips agree on u0."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.repeats import PureError
from tumble.calibrations.methods.dividing_head.observations import Observations

POLES: Final[dict[str, tuple[str, float, float]]] = {
    "x": ("face-up", -90.0, 90.0),
    "y": ("face-up", 180.0, 0.0),
    "z": ("edge", 180.0, 0.0),
}
"""Mount and head angles of each flip: first the pole where the axis points down, then the one where it points up."""

SEEKING_DEG = 45.0
"""A flip may seek its extremum this far from the nominal pole."""


@dataclass(frozen=True, kw_only=True)
class FlipMean:
    """u0 as one flip alone gives it: the mean of its two poles (equation 4 and its like)."""

    u0_v: float
    standard_uncertainty_v: float
    expected_v: float
    """What the joint fit says that this mean is, its own u0 and kxy taken together."""


@dataclass(frozen=True, kw_only=True)
class FlipClosure:
    """Whether the x, y and z flips give the same u0."""

    axes: dict[str, FlipMean]
    p_value: float | None
    """Chance of such a disagreement from the scatter of repeats alone; None with fewer than two flips."""
    worst: tuple[str, str, float, float] | None
    """The two axes that differ most, by how many volts more than the joint fit expects, and by how many standard
    uncertainties of the difference."""


def flip_closure(observations: Observations, expected_v: FloatArray, error: PureError) -> FlipClosure | None:
    """Compare the u0 of the flips; None where there is no complete flip.

    `expected_v` is the joint fit at every row. The uncertainty is the pure error; without repeats there is none and
    only the means are given.
    """
    from scipy.special import fdtrc  # takes a tenth of a second, in which a window is half up

    means = {axis: mean for axis in POLES if (mean := _flip_mean(observations, axis, expected_v, error))}
    if not means:
        return None
    uncertainties = np.array([mean.standard_uncertainty_v for mean in means.values()])
    if len(means) < 2 or not np.all(uncertainties > 0):
        return FlipClosure(axes=means, p_value=None, worst=None)
    excess = np.array([mean.u0_v - mean.expected_v for mean in means.values()])
    precision = uncertainties**-2
    centre = float(np.sum(precision * excess) / precision.sum())
    statistic = float(np.sum(precision * (excess - centre) ** 2))
    spare = len(means) - 1
    p_value = float(fdtrc(spare, error.degrees_of_freedom, statistic / spare))
    return FlipClosure(axes=means, p_value=p_value, worst=_worst(means))


def _worst(means: dict[str, FlipMean]) -> tuple[str, str, float, float]:
    names = list(means)
    pairs = [(a, b) for i, a in enumerate(names) for b in names[i + 1 :]]
    excess = {name: mean.u0_v - mean.expected_v for name, mean in means.items()}
    differences = [excess[a] - excess[b] for a, b in pairs]
    sigmas = [
        abs(difference) / np.hypot(means[a].standard_uncertainty_v, means[b].standard_uncertainty_v)
        for difference, (a, b) in zip(differences, pairs, strict=True)
    ]
    first = int(np.argmax(sigmas))
    return (*pairs[first], differences[first], float(sigmas[first]))


def _flip_mean(observations: Observations, axis: str, expected_v: FloatArray, error: PureError) -> FlipMean | None:
    mount, *poles = POLES[axis]
    at = [at_pole(observations, mount, pole) for pole in poles]
    counts = [int(np.count_nonzero(mask)) for mask in at]
    if 0 in counts:
        return None
    voltage = observations.output_v
    return FlipMean(
        u0_v=float(np.mean([voltage[mask].mean() for mask in at])),
        standard_uncertainty_v=float(
            error.standard_deviation * np.sqrt(sum(1 / n for n in counts)) / 2 if error.degrees_of_freedom else 0.0
        ),
        expected_v=float(np.mean([expected_v[mask].mean() for mask in at])),
    )


def at_pole(observations: Observations, mount: str, pole_deg: float) -> NDArray[np.bool_]:
    """Which rows are a flip's dwell at a pole; without a procedure column, every row that stands there."""
    away = (observations.angle_deg - pole_deg + 180.0) % 360.0 - 180.0
    if observations.procedure is None:
        near = np.abs(away) < 1e-3
    else:
        near = (observations.procedure == "flip") & (np.abs(away) < SEEKING_DEG)
    return np.asarray((observations.mounts == mount) & near)
