"""What to ask about a table of head and reference that contradicts itself, before anything is explained."""

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.head_reference.observations import HeadObservations
from tumble.messages import Message

_FOLLOWS = 0.5
"""A reference that follows the head keeps a direction from it: mean resultant length (Mardia) of the differences."""
_TOLD_DEG = 90.0
"""On a shorter arc even a reference that does not follow keeps some direction from the head."""
_CLEARER = 10.0
"""Another reading of the table must leave so many times less than the one that it gives."""
_STILL = 1e-9
"""A reference that says the same to this part of a degree never moved."""
_MOST_TURNS = 9


def question(observations: HeadObservations) -> tuple[str, ...]:
    """Sentences for a reference that does not follow the head; none where it does. Raises `ValueError` without one."""
    if observations.reference_deg is None:
        raise ValueError(Message("{source}: there is no column reference_deg", source=observations.source))
    reference_deg, angle_deg = observations.reference_deg, observations.angle_deg
    if len(angle_deg) < 3 or not np.ptp(angle_deg):
        return ()
    if np.ptp(reference_deg) < _STILL:
        return (
            Message(
                "{source}: the reference is {reference_deg:g}° in every row, however the head is turned; is it "
                "connected?",
                source=observations.source,
                reference_deg=reference_deg[0],
            ),
        )
    left_deg = _spread_deg(reference_deg - angle_deg)
    readings = {reason: _spread_deg(away) for reason, away in _other_readings(reference_deg, angle_deg).items()}
    closest = min(readings, key=lambda reason: readings[reason])
    clear = left_deg > _CLEARER * readings[closest]
    if not clear and (_together(reference_deg - angle_deg) > _FOLLOWS or np.ptp(angle_deg) < _TOLD_DEG):
        return ()
    near = _together(_other_readings(reference_deg, angle_deg)[closest]) > _FOLLOWS
    why = (
        Message("as if {reading}", reading=closest)
        if clear or near
        else Message("check that both belong to the same axis")
    )
    return (Message("{source}: the reference does not follow the head, {why}", source=observations.source, why=why),)


def _other_readings(reference_deg: FloatArray, angle_deg: FloatArray) -> dict[Message, FloatArray]:
    """Difference of reference and head if the table were to be read otherwise, by what is then to be done."""
    return {
        Message("it turns against the head; change its sign"): reference_deg + angle_deg,
        Message("it is in radians; write it in degrees"): np.rad2deg(reference_deg) - angle_deg,
        Message("the head is in radians; write it in degrees"): reference_deg - np.rad2deg(angle_deg),
        **{
            Message("it counts {turns} turns for one; divide it", turns=n): reference_deg - n * angle_deg
            for n in range(2, _MOST_TURNS)
        },
        **{
            Message("the head counts {turns} turns for one of it; divide angle_deg", turns=n): (
                n * reference_deg - angle_deg
            )
            for n in range(2, _MOST_TURNS)
        },
    }


def _spread_deg(difference_deg: FloatArray) -> float:
    """Typical distance from the middle direction, whatever the turn: a median, so that single slips do not count."""
    middle_deg = np.rad2deg(np.angle(np.mean(np.exp(1j * np.deg2rad(difference_deg)))))
    away_deg = (difference_deg - middle_deg + 180.0) % 360.0 - 180.0
    return float(np.median(np.abs(away_deg - np.median(away_deg))))


def _together(difference_deg: FloatArray) -> float:
    return float(np.abs(np.mean(np.exp(1j * np.deg2rad(difference_deg)))))
