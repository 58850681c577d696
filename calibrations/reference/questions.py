"""What to ask about a table of head and reference that contradicts itself, before anything is explained."""

import numpy as np

from calibrations.geometry import FloatArray
from calibrations.observations import Observations

_FOLLOWS = 0.5
"""A reference that follows the head keeps a direction from it: mean resultant length (Mardia) of the differences."""


def question(observations: Observations) -> tuple[str, ...]:
    """Sentences for a reference that does not follow the head; none where it does. Raises `ValueError` without one."""
    if observations.reference_deg is None:
        raise ValueError(f"{observations.source}: there is no column reference_deg")
    reference_deg, angle_deg = observations.reference_deg, observations.angle_deg
    if _together(reference_deg - angle_deg) > _FOLLOWS or np.ptp(angle_deg) < 90.0:
        return ()
    tried: dict[str, FloatArray] = {
        "it turns against the head; change its sign": reference_deg + angle_deg,
        "it is in radians; write it in degrees": np.rad2deg(reference_deg) - angle_deg,
        "the head is in radians; write it in degrees": reference_deg - np.rad2deg(angle_deg),
        **{f"it counts {n} turns for one; divide it": reference_deg - n * angle_deg for n in range(2, 9)},
    }
    better = [reason for reason, difference in tried.items() if _together(difference) > _FOLLOWS]
    why = f"as if {better[0]}" if better else "check that both belong to the same axis"
    return (f"{observations.source}: the reference does not follow the head, {why}",)


def _together(difference_deg: FloatArray) -> float:
    return float(np.abs(np.mean(np.exp(1j * np.deg2rad(difference_deg)))))
