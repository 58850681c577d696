"""The exciters of a stand: they set a condition of dwells, and nobody is near the unit while it is shaken.

An exciter is brought to a level by a ramp, and everything that it is told is read back. Before a person is asked for
something, while a run pauses, and where any link is lost, the drive is at zero; before the next dwell it is put back.
What the references say counts, too: that they shake no more than they may, and at rest not at all.
"""

import math
from collections.abc import Callable, Collection, Iterable, Sequence
from typing import Final

from tumble.drivers.errors import DeviceError, LinkLostError, NoReplyError
from tumble.drivers.excitation import REST, Excitation, excitation_of
from tumble.drivers.protocols import Block, Exciter, ExciterStatus, Reconnectable, Stand
from tumble.messages import Message
from tumble.procedures.driven import check_driven, check_quiet, check_readings
from tumble.procedures.losses import Losses

STEPS: Final = 8
"""Levels of a ramp."""
_TRIES: Final = 10
_RETRY_S: Final = 0.5
"""Over these the drive is tried to be brought to zero where the way to it is gone."""


class Exciters:
    """Drives the exciters of a stand, by the condition that each sets.

    Parameters
    ----------
    stand
        Instruments and clock.
    losses
        Whose links were lost.
    look
        Takes a short block of every sampler; it is looked at on the way to a level.
    check
        Called while it is waited; raises where the run should end.
    """

    def __init__(
        self, stand: Stand, losses: Losses, look: Callable[[], Sequence[Block]], check: Callable[[], object]
    ) -> None:
        self._stand, self._losses, self._look, self._check = stand, losses, look, check
        self._wanted: dict[str, Excitation] = {}
        self._reached: dict[str, Excitation] = {}

    @property
    def names(self) -> Collection[str]:
        """The conditions that they set."""
        return self._stand.exciters.keys()

    def begin(self) -> None:
        """Bring all to rest: a run that was killed may have left them driving. Raises `DeviceError`."""
        for name in self.names:
            self._wanted.setdefault(name, REST)
        self.calm()

    def excite(self, name: str, text: str) -> str:
        """Bring an exciter to what a condition says; returns what it says of itself then. Raises `DeviceError`."""
        self._wanted[name] = excitation_of(text)
        self.sustain()
        status = self._status(name)
        return status.excitation.text if status.on else REST.text

    def sustain(self) -> None:
        """Make sure that every exciter drives as it shall, and bring it there where it does not.

        Raises
        ------
        DeviceError
            One drives otherwise than it was told, complains, or shakes more than it may.
        """
        for name, wanted in self._wanted.items():
            if self._reached.get(name, REST) != wanted:
                self._lower(name)
                self._raise_to(name, wanted)
            self._confirm(name, self._status(name))

    def inspect(self, blocks: Sequence[Block]) -> None:
        """After a dwell: nothing read more than it may, and all drive as before. Raises `DeviceError`."""
        if not self._wanted:
            return
        check_readings(self._title, self._stand.most, blocks)
        self._check_quiet(blocks)
        for name in self._wanted:
            self._confirm(name, self._status(name))

    def calm(self) -> None:
        """Bring all to rest for now. Raises `DeviceError` where the rest of one cannot be read back."""
        for name in self._wanted:
            self._lower(name)

    def clear(self) -> None:
        """Bring all to rest, and see that nothing shakes: a person may touch the unit then. Raises `DeviceError`."""
        self.calm()
        if self._wanted and self._stand.quiet:
            self._check_quiet(self._look())

    def calm_those_heard(self) -> None:
        """The same where links are lost: whoever cannot be heard is told once it is back."""
        for name in self._wanted:
            try:
                self._rest(name)
            except (LinkLostError, NoReplyError):
                self._losses.names.add(name)
                self._reached[name] = REST  # it is told so before it is told anything else

    def leave(self) -> list[str]:
        """Drive at zero, output off, read back, over a new connection where the old one is gone.

        Returns a sentence for each of which that could not be read back.
        """
        failures = [failure for name in self._wanted if (failure := self._left(name))]
        if self._wanted and self._stand.quiet and not failures:
            try:
                self._check_quiet(self._look())
            except DeviceError as error:
                failures += [str(error)] if error.device == self._title else []  # a meter that is gone says nothing
        return failures

    def _left(self, name: str) -> str:
        failure: DeviceError | None = None
        for number in range(_TRIES):
            try:
                self._made_safe(name, anew=number > 0)
                return ""
            except (LinkLostError, NoReplyError) as error:
                failure = error
                self._stand.clock.sleep(_RETRY_S)
            except DeviceError as error:
                failure = error
                break
        assert failure is not None
        return Message(
            "{title}: its drive could not be brought to zero and read back ({happened}); switch its amplifier off "
            "by hand before anybody touches the unit",
            title=self._stand.title(name),
            happened=failure.happened,
        )

    def _made_safe(self, name: str, *, anew: bool) -> None:
        exciter = self._stand.exciters[name]
        if anew and isinstance(exciter, Reconnectable):
            exciter.reconnect()
        self._rest(name)

    def _rest(self, name: str) -> None:
        """Tell it to rest, and read that back. Raises `DeviceError`."""
        with self._losses.using(name):
            self._stand.exciters[name].make_safe()
        status = self._status(name)
        if status.on:
            raise DeviceError(
                self._stand.title(name),
                Message("was told to rest and still drives ({back})", back=status.excitation.text),
                Message("switch its amplifier off by hand, then look at it"),
            )
        self._reached[name] = REST

    def _lower(self, name: str) -> None:
        """Go down from where it is, and rest."""
        if (reached := self._reached.get(name, REST)) != REST:
            for step in range(STEPS - 1, 0, -1):
                self._set(name, reached.scaled(_smooth(step / STEPS)))
        self._rest(name)

    def _raise_to(self, name: str, wanted: Excitation) -> None:
        """Go up from rest, and look at every level at what comes of it."""
        if wanted == REST:
            return
        for step in range(1, STEPS + 1):
            self._check()
            self._set(name, wanted.scaled(_smooth(step / STEPS)))
            self._confirm(name, self._status(name))
            if self._stand.most:
                check_readings(self._title, self._stand.most, self._look())

    def _set(self, name: str, level: Excitation) -> None:
        exciter = self._stand.exciters[name]
        with self._losses.using(name):
            exciter.drive(level)
        self._reached[name] = level
        self._stand.clock.sleep(exciter.ramp_s / STEPS)

    def _status(self, name: str) -> ExciterStatus:
        exciter: Exciter = self._stand.exciters[name]
        with self._losses.using(name):
            return exciter.status()

    def _confirm(self, name: str, status: ExciterStatus) -> None:
        """Make sure that it does what it was told last. Raises `DeviceError`."""
        told = self._reached.get(name, REST)
        if told != REST and not status.on:
            self._losses.names.add(name)
        check_driven(self._stand.title(name), told, status)

    def _check_quiet(self, blocks: Iterable[Block]) -> None:
        """Nothing shakes where all shall rest. Raises `DeviceError`."""
        if all(reached == REST for reached in self._reached.values()):
            check_quiet(self._title, self._stand.quiet, blocks)

    @property
    def _title(self) -> str:
        return self._stand.title(next(iter(self.names)))


def _smooth(fraction: float) -> float:
    """From 0 to 1 without a step of the rate."""
    return 1.0 if fraction >= 1.0 else 0.5 - 0.5 * math.cos(math.pi * fraction)
