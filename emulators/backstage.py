"""What people do at an emulated stand: seat the unit, switch it off and on, turn a head that has no motor.

No protocol of an instrument has words for that. A program that drives an emulated stand finds its backstage by the
address of an instrument, through a small file in the user's state folder, and tells it what a person would have done.
The file says how fast time goes there, and which process serves the stand: a file that another user wrote, or whose
process is gone, is no backstage.
"""

import json
import os
import socket
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from hashlib import sha256
from typing import Final

from tumble.drivers.clock import Clock, SystemClock
from tumble.drivers.errors import DeviceError
from tumble.drivers.links.places import one_name
from tumble.drivers.private_files import private_folder, read_private, write_private
from tumble.drivers.processes import started
from tumble.drivers.simulated.head import SimulatedHead
from tumble.drivers.simulated.worlds import axis_of
from tumble.drivers.tables import HEAD, MOUNT
from tumble.emulators.faults import Faults
from tumble.emulators.serving import serve_tcp
from tumble.emulators.speed import FasterClock
from tumble.emulators.world import SharedWorld
from tumble.messages import Message

_TIMEOUT_S: Final = 5.0
_FOLDER: Final = "emulated"
_DONE: Final = "done"
_TURNING: Final = "turning"


class BackstageSession:
    """Hears one thing that a person does, a line each, and answers `done`, or what is wrong. Fits `Session`.

    `seat MOUNT`, or `set CONDITION VALUE` for any condition of the world; `switch on`; `turn ANGLE`, which begins to
    turn the head, `turn off`, which leaves it where it is; `look`, which is answered `turning` as long as it turns.
    Another positioner is named: `turn outer 45`, `look outer`.

    The fault `not_seated` has it answer so without having seated the unit.
    """

    def __init__(self, shared: SharedWorld, faults: Faults) -> None:
        self._shared = shared
        self._faults = faults

    def received(self, data: bytes) -> bytes:
        """Do what one line says."""
        verb, _, what = data.decode("utf-8", "replace").strip().partition(" ")
        self._faults.note_command(data)
        with self._shared.lock:
            try:
                return f"{self._do(verb, what)}\n".encode()
            except (ValueError, DeviceError) as error:
                return f"{error}\n".encode()

    def due(self) -> bytes:
        """Nothing is said unasked."""
        return b""

    def _do(self, verb: str, what: str) -> str:
        match verb, what:
            case "seat", mount:
                self._set(MOUNT, mount)
            case "set", _:
                self._set(*what.partition(" ")[::2])
            case "switch", "on":
                self._shared.world.switch_on()
            case "turn", _:
                self._turn(*what.rpartition(" ")[::2])
            case "look", positioner:
                return _TURNING if self._axis(positioner).status().moving else _DONE
            case _:
                raise ValueError(Message("{verb} {what} is nothing that is done backstage", verb=verb, what=what))
        return _DONE

    def _set(self, condition: str, value: str) -> None:
        setters = self._shared.world.setters
        if condition not in setters:
            raise ValueError(
                Message("nobody sets {condition} here, only {known}", condition=condition, known=", ".join(setters))
            )
        if not self._faults.take("not_seated"):
            setters[condition](value)

    def _turn(self, positioner: str, angle_deg: str) -> None:
        axis = self._axis(positioner)
        if angle_deg == "off":
            axis.stop()
        else:
            axis.start_move(float(angle_deg))

    def _axis(self, positioner: str) -> SimulatedHead:
        return axis_of(self._shared.world.positioners, positioner or HEAD)


class Backstage:
    """The way to the people at an emulated stand, and the clock by which they live."""

    def __init__(self, port: int, clock: Clock, conditions: Sequence[str] = (MOUNT,)) -> None:
        self._port = port
        self._conditions = tuple(conditions)
        self.clock = clock

    @property
    def setters(self) -> Mapping[str, Callable[[str], None]]:
        """What a person may set here between dwells, by condition; each raises `DeviceError`."""
        return {condition: partial(self.set_to, condition) for condition in self._conditions}

    def set_to(self, condition: str, value: str) -> None:
        """Set a condition. Raises `DeviceError`."""
        self._tell(f"set {condition} {value}")

    def seat(self, mount: str) -> None:
        """Seat the unit. Raises `DeviceError`."""
        self._tell(f"seat {mount}")

    def switch_on(self) -> None:
        """Switch the unit off and on. Raises `DeviceError`."""
        self._tell("switch on")

    def turn(self, angle_deg: float, positioner: str = HEAD) -> None:
        """Begin to turn a positioner by hand. Raises `DeviceError`."""
        self._tell(f"turn {positioner} {angle_deg!r}")

    def let_go(self, positioner: str = HEAD) -> None:
        """Leave it where it is. Raises `DeviceError`."""
        self._tell(f"turn {positioner} off")

    def turning(self, positioner: str = HEAD) -> bool:
        """Whether it still turns. Raises `DeviceError`."""
        return self._tell(f"look {positioner}") == _TURNING

    def hand(self, positioner: str) -> "BackstageHand":
        """What turns a positioner that has no motor."""
        return BackstageHand(self, positioner)

    def alive(self) -> bool:
        """Whether somebody is there."""
        try:
            socket.create_connection(("127.0.0.1", self._port), timeout=_TIMEOUT_S).close()
        except OSError:
            return False
        return True

    def _tell(self, line: str) -> str:
        try:
            with socket.create_connection(("127.0.0.1", self._port), timeout=_TIMEOUT_S) as connection:
                connection.sendall(f"{line}\n".encode())
                answer = connection.makefile("rb").readline().decode().strip()
        except OSError as error:
            raise DeviceError(
                Message("emulated stand"),
                Message("{line}: nobody heard it ({error})", line=line, error=error),
                Message("start it again"),
            ) from error
        if answer not in (_DONE, _TURNING):
            raise DeviceError(
                Message("emulated stand"),
                Message("{line}: {answer}", line=line, answer=answer or Message("no answer")),
                Message("look at what is asked of it"),
            )
        return answer


@dataclass(frozen=True)
class BackstageHand:
    """Turns one positioner of an emulated stand by hand; all of it raises `DeviceError`."""

    backstage: Backstage
    positioner: str

    def turn(self, angle_deg: float) -> None:
        """Begin to turn it."""
        self.backstage.turn(angle_deg, self.positioner)

    def let_go(self) -> None:
        """Leave it where it is."""
        self.backstage.let_go(self.positioner)

    def turning(self) -> bool:
        """Whether it still turns."""
        return self.backstage.turning(self.positioner)


@contextmanager
def backstage_of(shared: SharedWorld, addresses: Sequence[str], faults: Faults | None = None) -> Iterator[None]:
    """Open the backstage of a world whose instruments have these addresses, as long as the context lasts."""
    of_operator = faults or Faults()
    with serve_tcp(lambda: BackstageSession(shared, of_operator), terminators=b"\n") as server:
        pace = shared.clock.pace if isinstance(shared.clock, FasterClock) else None
        process = os.getpid()
        known = {"port": server.port, "process": process, "started": started(process), "pace": pace}
        known["conditions"] = list(shared.world.setters)
        folder = private_folder(_FOLDER)
        entries = [folder / _entry(address) for address in addresses]
        try:
            for entry in entries:
                write_private(entry, json.dumps(known))
            yield
        finally:
            for entry in entries:
                entry.unlink(missing_ok=True)


def find_backstage(addresses: Sequence[str], check: Callable[[], object] = lambda: None) -> Backstage | None:
    """The backstage of the emulated stand to which an instrument with one of these addresses belongs, if any.

    `check` is called while hosts are looked up, and may raise.
    """
    for address in addresses:
        try:
            known = json.loads(read_private(private_folder(_FOLDER) / _entry(address, check)))
            clock = FasterClock(**known["pace"]) if known["pace"] else SystemClock()
            backstage = Backstage(int(known["port"]), clock, known["conditions"])
            running = known["started"] and started(int(known["process"])) == known["started"]
        except (OSError, ValueError, KeyError, TypeError, RuntimeError):  # the last: deep nesting, no home
            continue
        if running and backstage.alive():
            return backstage
    return None


def _entry(address: str, check: Callable[[], object] = lambda: None) -> str:
    """Name of the file that says where the backstage of an instrument is."""
    return f"{sha256(one_name(address, check).encode()).hexdigest()[:24]}.json"
