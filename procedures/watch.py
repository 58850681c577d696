"""Whether a positioner that was sent somewhere does what it was told."""

from typing import Final

from tumble.drivers.errors import DeviceError
from tumble.drivers.protocols import PositionerStatus
from tumble.messages import Message

_PATIENCE: Final = 2.0
_MARGIN_S: Final = 5.0
_STALL_S: Final = 2.0
_ASTRAY_DEG: Final = 1.0
"""How far a head may get beside its way: it may swing past its target a little."""


class Watch:
    """Follows one move; every status on its way is shown to it.

    The move may take twice the time it should, plus 5 s. A head that says it moves, and does not get on, is given up
    after some 5 s; one that rests elsewhere, after 2 s. No head may be more than 1 deg beside its way.

    Parameters
    ----------
    start_deg, angle_deg
        From where, and where to.
    speed_deg_s
        Of the head.
    tolerance_deg
        Less is no motion.
    now_s
        When it set out, by the stand's clock.
    title
        What sentences call it.
    """

    def __init__(
        self, start_deg: float, angle_deg: float, *, speed_deg_s: float, tolerance_deg: float, now_s: float, title: str
    ) -> None:
        self._start_deg, self._angle_deg = start_deg, angle_deg
        self._tolerance_deg = tolerance_deg
        self._title = title
        self._deadline_s = now_s + allowed_s(abs(angle_deg - start_deg), speed_deg_s)
        self._unmoved_s = allowed_s(tolerance_deg, speed_deg_s)
        self._last_deg, self._last_s = start_deg, now_s

    def look(self, status: PositionerStatus, now_s: float) -> None:
        """Look at a head that has not arrived. Raises `DeviceError` where it will not, or is where it must not be."""
        if abs(status.angle_deg - self._last_deg) > self._tolerance_deg:
            self._last_deg, self._last_s = status.angle_deg, now_s
        low_deg, high_deg = sorted((self._start_deg, self._angle_deg))
        if not low_deg - _ASTRAY_DEG <= status.angle_deg <= high_deg + _ASTRAY_DEG:
            raise DeviceError(
                self._title,
                Message(
                    "is at {reported_deg:.4f} deg on its way from {start_deg:g} to {target_deg:g} deg",
                    reported_deg=status.angle_deg,
                    start_deg=self._start_deg,
                    target_deg=self._angle_deg,
                ),
                Message("check steps_per_deg with its sign, and what else turns it, then resume the run"),
            )
        rested_s = now_s - self._last_s
        if now_s > self._deadline_s or rested_s > (self._unmoved_s if status.moving else _STALL_S):
            raise self._late(status)

    def _late(self, status: PositionerStatus) -> DeviceError:
        reported_deg, target_deg = status.angle_deg, self._angle_deg
        moves = Message(
            "still moves at {reported_deg:.4f} deg when it should long have stood at {target_deg:g} deg",
            reported_deg=reported_deg,
            target_deg=target_deg,
        )
        stands = Message(
            "stands at {reported_deg:.4f} deg when it should long have stood at {target_deg:g} deg",
            reported_deg=reported_deg,
            target_deg=target_deg,
        )
        remedy = Message("look for what blocks it, check its drive and speed, then resume the run")
        return DeviceError(self._title, moves if status.moving else stands, remedy)


def allowed_s(way_deg: float, speed_deg_s: float) -> float:
    """Time that a head may take for a way."""
    return _PATIENCE * way_deg / speed_deg_s + _MARGIN_S
