"""The kinds of fault: what goes wrong with the instruments, the operator, the computer and the program."""

import errno
import os
import signal
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from threading import Timer
from typing import Final, Literal

from benchmarks.endurance.emulated import EmulatedStand, Pair
from tumble.drivers.links.socketcand import SocketcandBus
from tumble.emulators.faults import At, Fault
from tumble.emulators.faults import Kind as Named

Does = Callable[[EmulatedStand, Path], None]
"""What a fault does at a stand whose run is being recorded in a file."""

_LATE_S: Final = 1.2
"""Later than any driver waits for an answer, in real time."""
_AWAY_S: Final = 3.0
FOR_GOOD_S: Final = 60.0
"""By the stand's clock; the engine waits 30 s for a link."""
_SECOND_INTERRUPT_S: Final = 0.01
METERS: Final[tuple[Pair, ...]] = ("serial", "plain meter", "Keithley 2000")
WITH_EVERY_METER: Final[tuple[Pair, ...]] = (*METERS, "CAN")


@dataclass(frozen=True, kw_only=True)
class Kind:
    """A kind of fault."""

    name: str
    does: Does
    device: Literal["head", "daq", "operator", "program"]
    pairs: tuple[Pair, ...] = ("serial", "CAN")
    early: bool = False
    """Whether it has to be there before a command that it shall hit."""
    other_unit: bool = False
    """Whether another instrument stands there afterwards, so that the run must not go on."""


def _goes_wrong(
    device: Literal["head", "daq", "operator"], kind: Named, real_s: float = 0.0, stand_s: float = 0.0
) -> Does:
    def do(stand: EmulatedStand, _: Path) -> None:
        lasts_s = real_s + stand_s / stand.speed
        stand.faults.add(Fault(device=device, kind=kind, at=At(time_s=0.0), lasts_s=lasts_s))

    return do


def _habit(kind: Named, real_s: float = 0.0) -> Does:
    """The drive has a habit from then on."""
    return _goes_wrong("head", kind, real_s=real_s)


def _all(*parts: Does) -> Does:
    def do(stand: EmulatedStand, recording: Path) -> None:
        for part in parts:
            part(stand, recording)

    return do


def _signal(number: int) -> Does:
    return lambda *_: os.kill(os.getpid(), number)


def _interrupt_twice(*_: object) -> None:
    os.kill(os.getpid(), signal.SIGINT)
    again = Timer(_SECOND_INTERRUPT_S, os.kill, (os.getpid(), signal.SIGINT))
    again.daemon = True
    again.start()


def _set_back(stand: EmulatedStand, _: Path) -> None:
    stand.clock.set_by_s = -86_400.0


def _remove(_: EmulatedStand, recording: Path) -> None:
    recording.unlink()


def _fill_buffer(*_: object) -> None:
    """The next frame cannot be sent: the computer's buffer is full, as Linux says (ENOBUFS), and not for long."""
    right = SocketcandBus.send

    def send(*_: object, **__: object) -> None:
        SocketcandBus.send = right  # type: ignore[method-assign]
        raise OSError(errno.ENOBUFS, "No buffer space available")

    SocketcandBus.send = send  # type: ignore[method-assign]


def _fill_disk(_: EmulatedStand, recording: Path) -> None:
    """Nothing can be written beyond the present size of the recording: the kernel says so (setrlimit(2))."""
    if sys.platform != "win32":
        import resource  # not on Windows

        size = recording.stat().st_size
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, resource.getrlimit(resource.RLIMIT_FSIZE)[1]))


def make_room() -> None:
    """Take back that the disk is full."""
    if sys.platform != "win32":
        import resource  # not on Windows

        hard = resource.getrlimit(resource.RLIMIT_FSIZE)[1]
        resource.setrlimit(resource.RLIMIT_FSIZE, (hard, hard))


def _of_instrument(device: Literal["head", "daq"]) -> list[Kind]:
    """What may happen to either."""
    pairs = WITH_EVERY_METER if device == "daq" else ("serial", "CAN")
    wires: dict[Named, str] = {
        "late": "reply late",
        "cut": "reply cut",
        "double": "reply doubled",
        "garble": "reply garbled",
        "reorder": "replies out of order",
        "wrong_checksum": "wrong checksum",
    }
    of_wire = [
        Kind(
            name=f"{device}: {words}",
            device=device,
            does=_goes_wrong(device, kind, real_s=_LATE_S),
            pairs=pairs,
            early=True,
        )
        for kind, words in wires.items()
    ]
    drop = _goes_wrong(device, "drop", stand_s=_AWAY_S)
    swapped = _all(_goes_wrong(device, "swapped"), drop)
    return [
        *of_wire,
        Kind(name=f"{device}: port vanishes and returns", device=device, does=drop, pairs=pairs),
        Kind(
            name=f"{device}: port vanishes for good",
            device=device,
            does=_goes_wrong(device, "drop", stand_s=FOR_GOOD_S),
            pairs=pairs,
        ),
        Kind(
            name=f"{device}: power lost", device=device, does=_goes_wrong(device, "power_loss", real_s=0.3), pairs=pairs
        ),
        Kind(
            name=f"{device}: another unit after a reconnect", device=device, does=swapped, pairs=pairs, other_unit=True
        ),
        Kind(name=f"{device}: bus-off", device=device, does=_goes_wrong(device, "bus_off", real_s=0.5), pairs=("CAN",)),
    ]


KINDS: Final = (
    *_of_instrument("head"),
    Kind(name="head: stall", device="head", does=_goes_wrong("head", "stall"), early=True),
    Kind(name="head: overshoot", device="head", does=_goes_wrong("head", "overshoot"), early=True),
    Kind(name="head: moving for ever", device="head", does=_goes_wrong("head", "moving_for_ever"), early=True),
    Kind(
        name="head: heartbeat lost",
        device="head",
        does=_goes_wrong("head", "heartbeat_lost", real_s=2.5),
        pairs=("CAN",),
    ),
    Kind(name="head: emergency message", device="head", does=_goes_wrong("head", "emergency"), pairs=("CAN",)),
    Kind(name="head: old bits", device="head", does=_habit("old_bits", real_s=0.3), pairs=("CAN",), early=True),
    Kind(name="head: target reached flickers", device="head", does=_habit("flicker"), pairs=("CAN",), early=True),
    Kind(name="head: no optional objects", device="head", does=_habit("without_options"), pairs=("CAN",), early=True),
    Kind(name="head: mode shown late", device="head", does=_habit("mode_shown_late"), pairs=("CAN",), early=True),
    Kind(name="head: foreign frames", device="head", does=_goes_wrong("head", "foreign_frames"), pairs=("CAN",)),
    Kind(name="head: noise on the bus", device="head", does=_goes_wrong("head", "noise"), pairs=("CAN",)),
    *_of_instrument("daq"),
    Kind(name="daq: foreign frames", device="daq", does=_goes_wrong("daq", "foreign_frames"), pairs=("CAN",)),
    Kind(name="daq: NaN", device="daq", does=_goes_wrong("daq", "nan"), pairs=WITH_EVERY_METER, early=True),
    Kind(name="daq: overload", device="daq", does=_goes_wrong("daq", "overload"), pairs=WITH_EVERY_METER, early=True),
    Kind(name="daq: frames lost", device="daq", does=_goes_wrong("daq", "frames_lost"), pairs=("CAN",), early=True),
    Kind(
        name="daq: error in its queue",
        device="daq",
        does=_goes_wrong("daq", "error_queued"),
        pairs=METERS,
        early=True,
    ),
    Kind(name="mount not changed though confirmed", device="operator", does=_goes_wrong("operator", "not_seated")),
    Kind(name="clock set back a day", device="program", does=_set_back),
    Kind(name="bus: buffer full for a moment", device="program", does=_fill_buffer, pairs=("CAN",)),
    Kind(name="disk full", device="program", does=_fill_disk),
    Kind(name="recording removed", device="program", does=_remove),
    Kind(name="SIGTERM", device="program", does=_signal(signal.SIGTERM)),
    Kind(name="SIGINT", device="program", does=_signal(signal.SIGINT)),
    Kind(name="SIGINT twice", device="program", does=_interrupt_twice),
)
