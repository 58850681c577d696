"""Soft limits, the same for every head."""

from tumble.drivers.errors import LimitError
from tumble.messages import Message


def check_limits(device: str, angle_deg: float, limits_deg: tuple[float, float]) -> None:
    """Make sure that a head may move to `angle_deg`; what is no angle is within no limits. Raises `LimitError`."""
    low_deg, high_deg = limits_deg
    if not low_deg <= angle_deg <= high_deg:
        raise LimitError(
            device,
            Message(
                "a move to {angle_deg:g} deg was asked for, outside the limits {low_deg:g} to {high_deg:g} deg",
                angle_deg=angle_deg,
                low_deg=low_deg,
                high_deg=high_deg,
            ),
            Message("choose another angle or correct limits_deg in the stand file"),
        )
