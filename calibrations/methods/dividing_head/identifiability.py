"""Which parameters are identifiable, on what the answer rests, and what would settle it."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import Compressed, compress
from tumble.calibrations.core.solutions import pseudo_inverse
from tumble.calibrations.methods.dividing_head.conditional import conditional
from tumble.calibrations.methods.dividing_head.fit import JointFit, names
from tumble.calibrations.methods.dividing_head.geometry import MOUNTS
from tumble.calibrations.methods.dividing_head.joint import Joint
from tumble.calibrations.methods.dividing_head.model import (
    ALPHA0,
    LINEAR,
    PARAMETERS,
    UNITS,
    basis,
    coefficients_jacobian,
)
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.messages import Message

SEAT_DEG = 1.0
"""A seat may be this far from the head's zero before anybody notices; for judging what alpha0 = 0 is worth."""
MATERIAL = 0.1
"""A shift below this part of the standard uncertainty does not matter."""
_SETTLING_SWEEP_DEG = np.arange(0.0, 400.0, 5.0)

_NO_SPARE_ROWS = Message("there are no more rows than parameters, so that nothing is left to state an uncertainty by")
_NEEDS = {
    "kx": Message("no row has gravity along Ox, or nothing separates it from another parameter"),
    "ky": Message("no row has gravity along Oy, or nothing separates it from another parameter"),
    "kz": Message("no row has gravity along Oz, or nothing separates it from another parameter"),
    "kxy": Message("no row has gravity along Ox and Oy at once"),
    "u0": Message("the rows do not separate it from the other parameters"),
}


@dataclass(frozen=True, kw_only=True)
class Identification:
    """What can be said of one parameter."""

    identifiable: bool
    reason: str = ""
    """Why it is not identifiable, in one sentence; empty where it is."""
    given: Mapping[str, float] = field(default_factory=dict)
    """The value of alpha0 for which this one stands, where alpha0 is not identifiable; otherwise empty."""
    rests_on: str = ""
    """The one parameter without which this one would not be identifiable, or nothing."""
    settled_by: tuple[str, ...] = ()
    """Mounts, each of which alone would end that dependence or make the parameter known."""
    remark: str = ""
    """What `rests_on` or `given` means, in one sentence; empty where there is none."""


def identify(joint: Joint) -> dict[str, Identification]:
    """Judge every parameter of a joint fit, by name.

    A parameter is identifiable only if every alpha0 that its interval contains gives it a bounded interval.
    """
    observations, compressed, fit = joint.observations, joint.compressed, joint.fit
    if joint.noise.used_degrees_of_freedom < 1:
        return dict.fromkeys(PARAMETERS, Identification(identifiable=False, reason=_NO_SPARE_ROWS))
    if fit.alpha0_fitted:
        estimable = _estimable_within(compressed, joint.profile.within_deg)
        verdicts = {name: _linear_verdict(name, bool(ok)) for name, ok in zip(LINEAR, estimable, strict=True)}
        verdicts["alpha0"] = Identification(identifiable=True)
        return _with_dependence(observations, compressed, fit, verdicts)
    verdicts = {name: _linear_verdict(name, bool(ok)) for name, ok in zip(LINEAR, fit.estimable[:ALPHA0], strict=True)}
    verdicts["alpha0"] = Identification(
        identifiable=False,
        reason=_ALPHA0_UNBOUNDED[verdicts["kxy"].identifiable],
        settled_by=mounts_that_settle(observations, fit),
    )
    return _with_condition(compressed, fit, joint.noise.used_v**2, verdicts)


_ALPHA0_UNBOUNDED: Final = {
    True: Message(
        "its 95% interval reaches 45 deg: only kxy separates it from ky and kz here, and kxy is not large enough"
    ),
    False: Message(
        "its 95% interval reaches 45 deg: only kxy separates it from ky and kz here, and kxy is not identifiable"
    ),
}
"""Why alpha0 is not identifiable, by whether kxy is."""


def _estimable_within(compressed: Compressed, alpha0_deg: FloatArray) -> NDArray[np.bool_]:
    return np.asarray(conditional(compressed, alpha0_deg).estimable[:, :ALPHA0].all(axis=0))


def _linear_verdict(name: str, identifiable: bool) -> Identification:
    if identifiable:
        return Identification(identifiable=True)
    reason = Message.joined(": ", (Message("its 95% interval is unbounded"), _NEEDS[name]))  # read back from a record
    return Identification(identifiable=False, reason=reason)


def _with_condition(
    compressed: Compressed, fit: JointFit, variance_v2: float, verdicts: dict[str, Identification]
) -> dict[str, Identification]:
    """Mark the values that stand for alpha0 = 0 only."""
    drift = (
        fit.inverse
        @ compressed.r
        @ (coefficients_jacobian(fit.theta)[:, ALPHA0] * SEAT_DEG)  # what alpha0 = SEAT_DEG does
    )
    drift[ALPHA0] = 0.0
    curvature = np.abs(fit.theta) * np.deg2rad(SEAT_DEG) ** 2 / 2
    uncertainty = np.sqrt(variance_v2 * np.diag(fit.inverse @ fit.inverse.T))
    result = dict(verdicts)
    for index, name in enumerate(LINEAR):
        shift = abs(drift[index]) + (curvature[index] if name != "u0" else 0.0)
        if verdicts[name].identifiable and shift > MATERIAL * uncertainty[index]:
            result[name] = replace(
                verdicts[name],
                given={"alpha0": 0.0},
                settled_by=verdicts["alpha0"].settled_by,
                remark=Message(
                    "{seat_deg:g} deg of alpha0 would change it by {shift:.2g} {unit}",
                    seat_deg=SEAT_DEG,
                    shift=shift,
                    unit=UNITS[name],
                ),
            )
    return result


_THROUGH_CURVATURE: Final = Message(
    "identifiable through the curvature kxy alone, which an undeclared second-order term imitates"
)


def _with_dependence(
    observations: Observations, compressed: Compressed, fit: JointFit, verdicts: dict[str, Identification]
) -> dict[str, Identification]:
    """Say which parameters rest on kxy alone: without it alpha0 would have no bounded interval."""
    determined = determined_without_kxy(compressed, fit)
    if determined[ALPHA0]:
        return verdicts
    mounts = mounts_that_settle(observations, fit)
    lost = set(names(fit.estimable & ~determined)) | {"alpha0"}
    return {
        name: replace(
            verdict,
            rests_on="kxy",
            settled_by=mounts,
            remark=_THROUGH_CURVATURE,
        )
        if verdict.identifiable and name in lost
        else verdict
        for name, verdict in verdicts.items()
    }


def determined_without_kxy(compressed: Compressed, fit: JointFit) -> NDArray[np.bool_]:
    """Which parameters would be determined if kxy were zero, shape (6 + terms,)."""
    without = fit.theta.copy()
    without[PARAMETERS.index("kxy")] = 0.0
    return pseudo_inverse(compressed.r @ coefficients_jacobian(without))[1]


def mounts_that_settle(observations: Observations, fit: JointFit) -> tuple[str, ...]:
    """Mounts of which one sweep, added to the rows, would make alpha0 identifiable without kxy."""
    theta = fit.theta[: len(PARAMETERS)].copy()
    theta[PARAMETERS.index("kxy")] = 0.0
    theta[PARAMETERS.index("kx")] = theta[PARAMETERS.index("kx")] or 1.0
    present = set(observations.mounts.tolist())
    return tuple(mount for mount in MOUNTS if mount not in present and _settles(observations, mount, theta))


def _settles(observations: Observations, mount: str, theta: FloatArray) -> bool:
    count = len(_SETTLING_SWEEP_DEG)
    sweep = Observations(row=np.arange(count), angle_deg=_SETTLING_SWEEP_DEG, mount=np.full(count, mount))
    functions = np.concatenate([basis(observations), basis(sweep)])
    rows = len(functions)
    together = compress(functions, np.zeros(rows), np.ones(rows))
    _, determined = pseudo_inverse(together.r @ coefficients_jacobian(theta))
    return bool(determined[ALPHA0])
