"""What a programme can tell of the five coefficients, worked out before anything shakes."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any, Final

import numpy as np

from tumble.app.stand import WrittenStand
from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.sentences import series
from tumble.drivers.excitation import excitation_of, frequencies_hz, peak_g
from tumble.drivers.mountings import Mounting
from tumble.drivers.tables import EXCITER, MOUNT
from tumble.messages import Message
from tumble.procedures.methods.vibration.motion import Measured, moved
from tumble.procedures.plan import Plan
from tumble.procedures.steps import Dwell

NAMES: Final = ("k_ii", "k_oo", "k_pp", "k_io", "k_ip")
_PLACES: Final = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2))
_TOLD: Final = 1e-6


@dataclass(frozen=True, kw_only=True)
class VibrationPromise:
    """Fits `tumble.app.job_part.Promise`."""

    levels_g: tuple[float, float]
    """Least and greatest peak; of random vibration four times its r.m.s. value."""
    frequencies_hz: tuple[float, float]
    rank: int
    """How many coefficients, or combinations of them, the dwells tell."""
    uncertainties_ug_g2: dict[str, float]
    """Of what is told, for dwells whose means are each known to 1 µg."""
    sums: tuple[str, ...]
    """What is told of coefficients that are not told alone."""

    @property
    def sentences(self) -> Sequence[str]:
        """For the terminal."""
        listed = [f"{name} {value:.2g}" for name, value in self.uncertainties_ug_g2.items()]
        untold = [name for name in NAMES if name not in self.uncertainties_ug_g2]
        found = [
            Message(
                "Peaks of {levels} g at {frequencies} Hz.",
                levels=_range(self.levels_g, ".3g"),
                frequencies=_range(self.frequencies_hz, ".4g"),
            ),
            Message(
                "Of five coefficients these dwells tell {rank}; standard uncertainty in µg/g² for each µg of a dwell: "
                "{listed}.",
                rank=self.rank,
                listed=", ".join(listed),
            ),
        ]
        if untold:
            found.append(Message("Not told alone: {names}.", names=series(untold)))
        return found

    def as_json(self) -> dict[str, Any]:
        """Further keys of `tumble.plan/1`."""
        return {
            "levels_g": list(self.levels_g),
            "frequencies_hz": list(self.frequencies_hz),
            "rank": self.rank,
            "uncertainty_ug_g2_per_ug": self.uncertainties_ug_g2,
        }


def _range(ends: tuple[float, float], digits: str) -> str:
    """Both ends of a range; one number where they are written alike."""
    low, high = (format(end, digits) for end in ends)
    return low if low == high else Message("{low} to {high}", low=low, high=high)


def promise(planned: Plan, stand: WrittenStand) -> VibrationPromise | None:
    """What a plan promises at a stand; None where nothing shakes in it."""
    exciter = stand.file.exciter_table
    arm_m = (exciter.arm_m if exciter else None) or 0.0
    dwells = [each.step for each in planned.steps if isinstance(each.step, Dwell)]
    excitations = [excitation_of(dwell.conditions[EXCITER]) for dwell in dwells]
    levels_g = [level for each in excitations if (level := peak_g(each, arm_m))]
    hz = [each for excitation in excitations for each in frequencies_hz(excitation)]
    if not levels_g:
        return None
    products = np.array([_products(dwell, arm_m) for dwell in dwells])
    covariance, told = _covariance(_beside_rests(products, dwells))
    alone = {name: vector for name, vector in zip(NAMES, np.eye(5), strict=True) if told(vector)}
    pairs = {
        f"{NAMES[first]}+{NAMES[second]}": np.eye(5)[first] + np.eye(5)[second]
        for first, second in combinations(range(5), 2)
        if not {NAMES[first], NAMES[second]} & alone.keys()
    }
    sums = {name: vector for name, vector in pairs.items() if told(vector)}
    return VibrationPromise(
        levels_g=(min(levels_g), max(levels_g)),
        frequencies_hz=(min(hz), max(hz)),
        rank=int(np.linalg.matrix_rank(_beside_rests(products, dwells), tol=_TOLD * np.abs(products).max())),
        uncertainties_ug_g2={
            name: float(np.sqrt(vector @ covariance @ vector)) for name, vector in {**alone, **sums}.items()
        },
        sums=tuple(sums),
    )


def _products(dwell: Dwell, arm_m: float) -> list[float]:
    """Mean products of a dwell as it is commanded."""
    measured = Measured(time_s=np.array([0.0, 1.0]), references_g={}, rest_variances_g2={}, arm_m=arm_m)
    table = Mounting.of(dwell.conditions[MOUNT]).table
    found = moved(excitation_of(dwell.conditions[EXCITER]), measured, table, None).products_g2
    return [float(found[place]) for place in _PLACES]


def _beside_rests(products: FloatArray, dwells: Sequence[Dwell]) -> FloatArray:
    """Products without what the rest output of each mounting takes up."""
    mountings = np.array([dwell.conditions[MOUNT] for dwell in dwells])
    left = products.copy()
    for mounting in dict.fromkeys(mountings.tolist()):
        rows = mountings == mounting
        left[rows] -= products[rows].mean(axis=0)
    return left


def _covariance(columns: FloatArray) -> tuple[FloatArray, Any]:
    """Covariance of the coefficients for 1 µg of each dwell, and whether a combination of them is told."""
    _, sizes, ways = np.linalg.svd(columns, full_matrices=False)
    seen = ways[sizes > _TOLD * sizes.max()]
    covariance = (seen.T / sizes[sizes > _TOLD * sizes.max()] ** 2) @ seen

    def told(vector: FloatArray) -> bool:
        return bool(np.linalg.norm(vector - seen.T @ (seen @ vector)) < _TOLD * 1e2)

    return np.asarray(covariance), told
