"""An emulated function generator of the 33500B class; its outputs drive the shakers of a simulated world.

Source: 33500B and 33600A Series Operating and Service Guide (33500-90901), "SCPI Programming Reference".
"""

import time
from collections.abc import Generator, Mapping
from functools import partial
from typing import Final

from tumble.emulators.faults import Faults, Kind
from tumble.emulators.scpi.command import Command
from tumble.emulators.scpi.language import ScpiError, Tree, number, units
from tumble.emulators.scpi.outputs import Output, commands_of
from tumble.emulators.scpi.shaking import Gains, Shaking
from tumble.emulators.scpi.status import Status
from tumble.emulators.world import SharedWorld

SERIAL: Final = "MY52800001"
OTHER_SERIAL: Final = "MY52899999"


class EmulatedGenerator:
    """Answers SCPI messages, and shakes. What `ScpiSession` needs of an instrument; its state outlives its clients.

    Parameters
    ----------
    world
        Whose exciter it drives.
    gains
        Acceleration for each volt, by channel and shaker.
    faults
        What goes wrong in it: `error_queued`, `swapped`, `power_loss`, `refused`, `stuck`, `alarm`.
    """

    deaf: Final = False

    def __init__(self, world: SharedWorld, gains: Gains, faults: Faults | None = None) -> None:
        self.lock, self.status = world.lock, Status()
        self._faults = faults or Faults()
        self._serial = SERIAL
        self._outputs: Mapping[int, Output] = {1: Output(), 2: Output()}
        self._shaking = Shaking(world, gains, self._outputs)
        self._until_s: dict[str, float] = {}
        self._overloaded = False
        takes = partial(self._faults.take, "refused")
        channels = [commands_of(channel, output, takes) for channel, output in self._outputs.items()]
        self._commands = Tree({**self._common(), **channels[0], **channels[1]})

    def abort(self) -> None:
        """There is nothing to wait for."""

    def execute(self, message: str) -> Generator[None, None, str]:
        """Carry out a message and return the answers, separated by ";"; what cannot be understood ends it."""
        yield from ()
        self._suffer()
        answers: list[str] = []
        try:
            for unit in units(message):
                reply = self.status.attempt(partial(self._commands.find(unit.header).perform, unit.parameters))
                if isinstance(reply, str):
                    answers.append(reply)
        except ScpiError as error:
            self.status.report(error)
        if self._faults.take("error_queued"):
            self.status.report(ScpiError(-310))
        self._shaking.follow(stuck=self._lasts("stuck"))
        return ";".join(answers)

    def _suffer(self) -> None:
        if self._faults.take("swapped"):
            self._serial = OTHER_SERIAL
        if self._faults.take("power_loss"):
            self.status.power_on()
            self._reset()
        self._overloaded = self._lasts("alarm")

    def _lasts(self, kind: Kind) -> bool:
        """Whether something that went wrong is so still."""
        if begun := self._faults.take(kind):
            self._until_s[kind] = time.monotonic() + begun.lasts_s
        return time.monotonic() < self._until_s.get(kind, -1.0)

    def _common(self) -> dict[str, Command]:
        status = self.status
        return {
            "*IDN?": Command(act=lambda: f"Agilent Technologies,33522B,{self._serial},3.05-1.19-2.00-52-00", last=True),
            "*RST": Command(act=self._reset),
            "*CLS": Command(act=status.clear),
            "*ESE": Command(act=self._enable, least=1, most=1),
            "*ESE?": Command(act=lambda: f"{status.enabled:+d}"),
            "*ESR?": Command(act=lambda: f"{status.take_events():+d}"),
            "*STB?": Command(act=lambda: f"{status.byte:+d}"),
            "*OPC": Command(act=status.complete),
            "*OPC?": Command(act=lambda: "1"),
            "*WAI": Command(act=lambda: None),
            "*TRG": Command(act=lambda: None),
            "SYSTem:ERRor[:NEXT]?": Command(act=status.take_error),
            "SYSTem:VERSion?": Command(act=lambda: "1999.0"),
            "SYSTem:LOCal": Command(act=lambda: None),
            "SYSTem:REMote": Command(act=lambda: None),
            "SYSTem:BEEPer[:IMMediate]": Command(act=lambda: None),
            "STATus:QUEStionable:CONDition?": Command(act=lambda: f"{self._overloaded:+d}"),
            "PHASe:SYNChronize": Command(act=self._shaking.align),
            "DISPlay": Command(act=lambda _on: None, least=1, most=1),
        }

    def _enable(self, mask: str) -> None:
        value = number(mask)
        if not 0 <= value <= 255:
            raise ScpiError(-222)
        self.status.enabled = round(value)

    def _reset(self) -> None:
        for output in self._outputs.values():
            output.reset()
