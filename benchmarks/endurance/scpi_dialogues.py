"""Blocks of readings of which one line came to harm: `python -m benchmarks.endurance.scpi_dialogues [BLOCKS]`.

A meter that takes one query a message is talked to in many lines. In every block one of them, a command or an answer,
has one kind of error (those of `scpi_frames`). What the driver then gives must be, to the last digit, what the meter
read in that block and in none before, or an error. Each dialect by itself, in virtual time. `READ-ONCE` gives every
reading once only, and what a line without checksums does to it cannot all be noticed: the driver says so when it
identifies such a meter, and how much is not noticed is stated here.
"""

import sys
import time
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from random import Random
from typing import Final

import numpy as np

from benchmarks.endurance.scpi_frames import ERRORS
from tumble.drivers.clock import VirtualClock
from tumble.drivers.errors import DeviceError, NoReplyError
from tumble.drivers.scpi import ScpiMultimeter
from tumble.drivers.scpi.codec import CorruptReplyError, parse_readings
from tumble.drivers.simulated import Simulated, build
from tumble.emulators.scpi import Multimeter, ScpiSession
from tumble.emulators.scpi.models import Messages
from tumble.emulators.world import SharedWorld

BLOCKS: Final = 1_000
SAMPLES: Final = 3
RATE_HZ: Final = 50.0
POLLS: Final = 100
METERS: Final[tuple[tuple[str, Messages, bool], ...]] = (
    ("34461A", "first", False),
    ("MODEL 2000", "any", False),
    ("MODEL DMM6500", "one", False),
    ("SDM3055", "first", False),
    ("SDM3065X", "first", False),
    ("DM3058", "one", False),
    ("PLAIN-5", "one", True),
)
READ_ONCE: Final[tuple[str, Messages, bool]] = ("READ-ONCE", "one", True)
FETCHES: Final = (b"FETC?", b"READ?", b"TRAC:DATA?")


class Wire:
    """A meter in virtual time, reached by a line on which one message or answer is spoilt. Fits the driver's link."""

    checksummed = False

    def __init__(self, model: str, messages: Messages) -> None:
        self.clock = VirtualClock()
        world = SharedWorld(build(Simulated(noise_v=0.1), clock=self.clock))
        self._session = ScpiSession(Multimeter(world, model=model, messages=messages))
        self._heard = self._waiting = b""
        self._fetching = False
        self.lines = 0
        """Messages and answers so far."""
        self.harmed = -1
        """Number of the one that is spoilt."""
        self.spoil: Callable[[bytes], bytes] = bytes
        self.before: set[bytes] = set()
        """The blocks before; by their noise no two are the same."""
        self.given: list[bytes] = []
        """What the meter answered when it was asked for readings, as it was before it came to harm."""

    def write(self, data: bytes) -> None:
        """Let the meter hear it."""
        self._heard += self._carried(data) if data.strip() else data
        *messages, self._heard = self._heard.split(b"\n")
        for message in messages:
            self._fetching = message.strip().lstrip(b":").startswith(FETCHES)
            self._answer(self._session.received(message + b"\n"))

    def read_line(self, terminator: bytes, timeout_s: float) -> bytes:
        """Wait in virtual time."""
        for _ in range(POLLS):
            if terminator in self._waiting:
                line, self._waiting = self._waiting.split(terminator, 1)
                return line + terminator
            self.clock.sleep(timeout_s / POLLS)
            self._answer(self._session.due())
        raise NoReplyError("wire", "gave no answer", "check it")

    def discard_input(self) -> None:
        """Throw away what has come."""
        self._waiting = b""

    def reopen(self) -> None:
        """It is never lost."""

    def _answer(self, answer: bytes) -> None:
        for line in answer.splitlines(keepends=True):
            if self._fetching:
                self.given.append(line.strip())
            self._waiting += self._carried(line)

    def _carried(self, line: bytes) -> bytes:
        number, self.lines = self.lines, self.lines + 1
        return self.spoil(line) if number == self.harmed else line


def verdict(wire: Wire, meter: ScpiMultimeter, singly: bool) -> str:
    """What came of a block."""
    wire.given.clear()
    try:
        block = meter.acquire(SAMPLES, RATE_HZ)
    except DeviceError:
        return "told"
    if block.voltage_v.tobytes() in wire.before:
        return "SILENT"
    wire.before.add(block.voltage_v.tobytes())
    given = [readings for line in wire.given if (readings := _parsed(line)) is not None]
    if singly:
        readings = np.concatenate(given) if given else np.empty(0)
        return "right" if np.isin(block.voltage_v, readings).all() else "SILENT"
    right = any(np.array_equal(readings[:SAMPLES], block.voltage_v) for readings in given)
    return "right" if right else "SILENT"


def _parsed(line: bytes) -> np.ndarray[tuple[int], np.dtype[np.float64]] | None:
    with suppress(CorruptReplyError):
        return parse_readings(line.decode("ascii"))
    return None


def spoil_blocks(model: str, messages: Messages, common: bool, blocks: int, random: Random) -> Counter[str]:
    """Have one line of every block come to harm."""
    wire = Wire(model, messages)
    meter = ScpiMultimeter(wire, wire.clock, common=common)
    meter.identify()
    before = wire.lines
    meter.acquire(SAMPLES, RATE_HZ)
    lines = wire.lines - before
    verdicts: Counter[str] = Counter()
    for block in range(blocks):
        error = ERRORS[block % len(ERRORS)]
        wire.harmed = wire.lines + random.randrange(lines)
        wire.spoil = lambda line, error=error: error(line, random) if len(line) > 2 else b""  # type: ignore[misc]
        verdicts[verdict(wire, meter, common)] += 1
    return verdicts


def main(blocks: int = BLOCKS) -> int:
    silent = 0
    for model, messages, common in (*METERS, READ_ONCE):
        began_s = time.perf_counter()
        verdicts = spoil_blocks(model, messages, common, blocks, Random(1))
        lasted_s = time.perf_counter() - began_s
        counts = ", ".join(f"{count} {name}" for name, count in sorted(verdicts.items()))
        print(f"{model}: {blocks} blocks in {lasted_s:.0f} s: {counts}")
        silent += verdicts["SILENT"] if model != READ_ONCE[0] else 0
    return int(silent > 0)


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
