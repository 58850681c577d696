"""The points of a run: each measured, recorded, and put to the person at the eyepiece where that is in doubt."""

from collections.abc import Callable, Sequence

from tumble.messages import Message
from tumble.procedures.events import Event, PointCompleted, SamplesAcquired, WarningRaised
from tumble.procedures.measuring import Measuring, Taken
from tumble.procedures.second_look import SecondLook
from tumble.procedures.steps import Dwell, Point, pose
from tumble.procedures.units import unit_of


class Taking:
    """Takes the points of a run, and the last one again.

    Parameters
    ----------
    measuring
        Takes dwells.
    eyepiece
        Looks again where a measurement contradicts a reading; None where nothing is read by eye.
    announce
        Takes events; a point is safe when it has taken its `PointCompleted`.
    check
        Raises where the run should end; called while somebody looks again.
    heed
        Called where a dwell is measured and not recorded yet; may raise, and then there is no point of it.
    settle_timeout_s
        How long a dwell waits for its outputs to settle.
    """

    def __init__(
        self,
        measuring: Measuring,
        eyepiece: SecondLook | None,
        announce: Callable[[Event], None],
        check: Callable[[], object],
        heed: Callable[[], object],
        settle_timeout_s: float,
    ) -> None:
        self._measuring, self._eyepiece = measuring, eyepiece
        self._announce, self._check, self._heed = announce, check, heed
        self._settle_timeout_s = settle_timeout_s
        if eyepiece is not None:
            eyepiece.attach(announce)
        self.points: list[Point] = []
        """All of the run so far."""
        self.began_s = 0.0
        """When the run began, by the stand's clock."""

    def take(self, dwell: Dwell) -> Point:
        """Measure a dwell. Raises `DeviceError`."""
        taken = self._measuring.measure(dwell)
        self._heed()
        point = taken.point(dwell, len(self.points), self.began_s)
        self.points.append(self._completed(taken, point, self.points))
        return self.points[-1]

    def take_again(self, dwell: Dwell) -> None:
        """Measure the dwell of the last point once more, in its place. Raises `DeviceError`."""
        *others, before = self.points
        taken = self._measuring.retake(dwell, before)
        now = self._completed(taken, taken.point(dwell, before.index, self.began_s, before.take + 1), others)
        self.points[-1] = now
        self._announce(WarningRaised(message=_retaken(before, now)))

    def _completed(self, taken: Taken, point: Point, others: Sequence[Point]) -> Point:
        """The point as it was recorded; `others` are those before it."""
        began_s = taken.began_s - self.began_s
        for block in taken.blocks:
            self._announce(SamplesAcquired(point=point.index, time_s=began_s, block=block, take=point.take))
        self._warn_of(taken, point)
        if self._eyepiece is not None:
            point = self._eyepiece.reconsidered(point, others, self._check)
        self._announce(PointCompleted(point=point))
        return point

    def _warn_of(self, taken: Taken, point: Point) -> None:
        if taken.unusable:
            bad = Message.counted(
                "{unusable} of {count} sample is an overload or no number; the point will be set aside",
                "{unusable} of {count} samples are overloads or no numbers; the point will be set aside",
                unusable=taken.unusable,
                count=taken.samples,
            )
            self._warn(point, bad)
        if not taken.settled:
            late = Message(
                "the output had not settled after {waited_s:g} s; the point is kept and marked",
                waited_s=self._settle_timeout_s,
            )
            self._warn(point, late)

    def _warn(self, point: Point, message: str) -> None:
        said = Message(
            "point {index} ({pose}): {message}",
            index=point.index,
            pose=pose(point.conditions, point.positions_deg),
            message=message,
        )
        self._announce(WarningRaised(message=said))


def _retaken(before: Point, now: Point) -> str:
    """What the reader of the result is told of a point that was taken again: what every channel gave each time."""
    readings = [
        Message(
            "{channel}: {now:.7g} {unit} now, {before:.7g} {unit} before",
            channel=channel,
            now=reading.mean,
            before=before.readings[channel].mean,
            unit=unit_of(channel),
        )
        for channel, reading in now.readings.items()
        if channel in before.readings
    ]
    return Message(
        "point {point} ({pose}) was taken again as the operator wished; the later reading is used ({readings})",
        point=now.index,
        pose=pose(now.conditions, now.positions_deg),
        readings=Message.joined("; ", readings),
    )
