"""Knowing the instruments, and getting them back where the link to one is lost.

What an instrument did while nobody could hear it is unknown. So it is identified again, a positioner is homed again and
goes back to where it stood, and the step that was interrupted begins anew: its point comes once, and of one piece.
"""

from collections.abc import Callable, Mapping
from contextlib import suppress
from types import MappingProxyType
from typing import Final, TypeVar

from tumble.drivers.errors import DeviceError, LinkLostError, NoReplyError, ReferenceLostError
from tumble.drivers.protocols import (
    Identity,
    Instrument,
    Reconnectable,
    Remarking,
    Resettable,
    Stand,
)
from tumble.messages import Message
from tumble.procedures.approach import Place
from tumble.procedures.axes import Axes
from tumble.procedures.events import Event, Identified, WarningRaised
from tumble.procedures.exciters import Exciters
from tumble.procedures.losses import Losses

RECONNECTING_S: Final = 30.0
"""How long a link may stay away."""
_RETRY_S: Final = 0.5
_LOSSES: Final = 10
"""How often one step may be interrupted."""
Result = TypeVar("Result")

NOWHERE: Final[Mapping[str, Place]] = MappingProxyType({})
"""Leaves the positioners where homing has left them."""


class Recovery:
    """Identifies the instruments of a stand, and repeats what a lost link interrupted.

    Parameters
    ----------
    stand
        Instruments, clock, and the serial numbers that the stand file demands.
    axes
        Moves of the stand's positioners.
    exciters
        Brought to rest while a link is away.
    losses
        Whose links were lost.
    announce
        Takes events.
    check
        Called while something is waited for; raises where the run should end.
    """

    def __init__(
        self,
        stand: Stand,
        axes: Axes,
        exciters: Exciters,
        losses: Losses,
        announce: Callable[[Event], None],
        check: Callable[[], object],
    ) -> None:
        self._stand = stand
        self._instruments = stand.instruments
        self._clock = stand.clock
        self._axes = axes
        self._exciters = exciters
        self._losses = losses
        self._announce = announce
        self._check = check
        self._known: dict[str, Identity] = {}

    def know(self, identities: Mapping[str, Identity]) -> None:
        """Expect the instruments with which the run was begun."""
        self._known.update(identities)

    def begin(self) -> None:
        """Ask all instruments who they are, and reset what an earlier run has left in fault.

        Raises `DeviceError` where one does not answer, is another, or has a fault whose cause is still there.
        """
        self.persist(self._identify)
        self.persist(self._reset)

    def reference(self) -> None:
        """Home every positioner that does not know its angle. Raises `DeviceError`."""
        self.persist(self._home_where_needed)

    def tell_of_winding(self, name: str, angle_deg: float) -> None:
        """Warn where a positioner that stood whole turns from zero no longer knows its angle. Raises `DeviceError`.

        One that finds its reference in every revolution then takes another for the first, and nobody counts the turns
        that the cable has already.
        """
        turns = abs(round(angle_deg / 360.0))
        if turns and not self._knows_its_angle(name):
            self._warn(
                Message.counted(
                    "{title}: has lost its reference at {angle_deg:g} deg; look whether its cable is wound by {count} "
                    "turn, and stop the run to unwind it by hand if it is",
                    "{title}: has lost its reference at {angle_deg:g} deg; look whether its cable is wound by {count} "
                    "turns, and stop the run to unwind it by hand if it is",
                    count=turns,
                    title=self._stand.title(name),
                    angle_deg=angle_deg,
                )
            )

    def tell_remarks(self) -> None:
        """Warn of what the instruments have put right by themselves."""
        for instrument in self._instruments.values():
            if isinstance(instrument, Remarking):
                for remark in instrument.remarks():
                    self._warn(remark)

    def last_remarks(self) -> list[str]:
        """What they have put right and nobody has told of yet."""
        remarking = [instrument for instrument in self._instruments.values() if isinstance(instrument, Remarking)]
        return [remark for instrument in remarking for remark in instrument.last_remarks()]

    def persist(self, action: Callable[[], Result], places: Mapping[str, Place] = NOWHERE) -> Result:
        """Carry out `action`; where a link is lost, get it back, take positioners to their `places` and begin again.

        Raises
        ------
        DeviceError
            Where a link stays away, another instrument answers, or links are lost over and over; and whatever else
            `action` raises.
        """
        interruption: DeviceError | None = None
        for _ in range(_LOSSES):
            try:
                if interruption is not None:
                    self._get_back(interruption, places)
                return action()
            except (LinkLostError, ReferenceLostError) as error:
                interruption = error
        assert interruption is not None
        raise interruption.saying(
            Message.counted(
                "was lost {count} time in one step, the last time so: {happened}",
                "was lost {count} times in one step, the last time so: {happened}",
                count=_LOSSES,
                happened=interruption.happened,
            ),
            interruption.remedy,
        )

    def _identify(self) -> None:
        for name, instrument in self._instruments.items():
            with self._losses.using(name):
                self._recognise(name, instrument.identify())

    def _reset(self) -> None:
        for name, instrument in self._instruments.items():
            with self._losses.using(name):
                if isinstance(instrument, Resettable) and (fault := instrument.reset_fault()):
                    self._warn(
                        Message(
                            "{title}: was left in fault by {fault}; the fault is reset",
                            title=self._stand.title(name),
                            fault=fault,
                        )
                    )

    def _home_where_needed(self) -> None:
        for name, positioner in self._stand.positioners.items():
            with self._losses.using(name):
                if not positioner.status().referenced:
                    self._warn(Message("{title}: has no reference; it is homed", title=self._stand.title(name)))
                    self._axes.motions[name].home(self._carry_on)

    def _get_back(self, interruption: DeviceError, places: Mapping[str, Place]) -> None:
        self._warn(
            Message("{device}: {happened}; trying to go on", device=interruption.device, happened=interruption.happened)
        )
        began_s = self._clock.monotonic_s()
        self._exciters.calm_those_heard()
        self._brake_those_heard()
        for name, instrument in self._instruments.items():
            self._reach(name, instrument, began_s + RECONNECTING_S)
        self._exciters.calm()
        for name in self._stand.positioners:
            with self._losses.using(name):
                self._put_back(name, places.get(name))
        self._losses.forget()
        self._warn(
            Message(
                "{device}: is back after {away_s:.1f} s; the step is repeated",
                device=interruption.device,
                away_s=self._clock.monotonic_s() - began_s,
            )
        )

    def _knows_its_angle(self, name: str) -> bool:
        with self._losses.using(name):
            return self._stand.positioners[name].status().referenced

    def _brake_those_heard(self) -> None:
        """Have nothing move while links are awaited: whoever cannot be heard is brought to rest once it is back."""
        for name, positioner in self._stand.positioners.items():
            with suppress(DeviceError):
                if name not in self._losses.names and positioner.status().turning:
                    self._axes.motions[name].brake()

    def _put_back(self, name: str, place: Place | None) -> None:
        """Home a positioner that was lost, and take it to its place; one that was not is brought to rest."""
        motion, status = self._axes.motions[name], self._stand.positioners[name].status()
        if name not in self._losses.names and status.referenced:
            if status.moving:
                motion.halt()
            return
        if place is not None:
            self.tell_of_winding(name, place.angle_deg)
        motion.home(self._carry_on)
        if place is not None:
            motion.return_to(place, self._carry_on)

    def _carry_on(self) -> bool:
        self._check()
        return False

    def _reach(self, name: str, instrument: Instrument, deadline_s: float) -> None:
        while True:
            try:
                with self._losses.using(name):
                    if name in self._losses.names and isinstance(instrument, Reconnectable):
                        instrument.reconnect()
                    return self._recognise(name, instrument.identify())
            except (LinkLostError, NoReplyError) as away:
                self._losses.names.add(name)
                if self._clock.monotonic_s() >= deadline_s or not isinstance(instrument, Reconnectable):
                    raise away.saying(
                        Message(
                            "{happened}, and did not come back within {patience_s:g} s",
                            happened=away.happened,
                            patience_s=RECONNECTING_S,
                        ),
                        Message("check its power and its cable, then resume the run"),
                    ) from away
            self._clock.sleep(_RETRY_S)
            self._check()

    def _recognise(self, name: str, identity: Identity) -> None:
        title, demanded = self._stand.title(name), self._stand.serials.get(name, "")
        if demanded and identity.serial != demanded:
            raise DeviceError(
                title,
                Message(
                    "has the serial number {serial}, and the stand file says {demanded}",
                    serial=identity.serial or Message("(none)"),
                    demanded=demanded,
                ),
                Message("connect the right one, or correct the stand file"),
            )
        known = self._known.setdefault(name, identity)
        if (identity.model, identity.serial) != (known.model, known.serial):
            raise DeviceError(
                title,
                Message(
                    "is {found}, and the run was begun with {known}",
                    found=_called(identity),
                    known=_called(known),
                ),
                Message("connect that one again, then resume the run"),
            )
        self._announce(
            Identified(instrument=name, model=identity.model, serial=identity.serial, firmware=identity.firmware)
        )
        for remark in identity.remarks:
            self._warn(Message("{title}: {remark}", title=title, remark=remark))

    def _warn(self, message: str) -> None:
        self._announce(WarningRaised(message=message))


def _called(identity: Identity) -> str:
    return Message("{model} number {serial}", model=identity.model, serial=identity.serial)
