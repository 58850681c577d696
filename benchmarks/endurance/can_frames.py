"""CAN frames with errors through both CAN instruments: `python -m benchmarks.endurance.can_frames [FRAMES]`.

Per protocol so many frames, each a right one with one kind of error:

- CAN DAQ, through its codec. Its checksum sees up to three wrong bits and any burst within 16 bits, so none of those
  may be accepted; of noise one frame in 65,536 passes any checksum of 16 bits, and what passes is counted apart.
- CiA 402, half of them to the emulated drive through the bus, which must go on answering and stay within its limits,
  half of them as answers to the driver. SDO has no checksum of its own (the wire's CRC guards it): what is accepted
  there is counted, but none may crash or hang it.
"""

import logging
import sys
import time
from collections import Counter
from collections.abc import Callable
from random import Random

import can

import tumble.drivers.cia402.node as master
from tumble.drivers.candaq import DaqFrames
from tumble.drivers.cia402 import objects
from tumble.drivers.cia402.node import DriveNode
from tumble.drivers.clock import VirtualClock
from tumble.drivers.errors import DeviceError
from tumble.drivers.simulated import Simulated, build
from tumble.emulators.cia402 import EmulatedDrive
from tumble.emulators.world import SharedWorld

FRAMES = 1_000_000
SLOW_S = 1.0
"""A frame that takes longer has hung, on whatever machine."""
CHECKED_EVERY = 1000
SERIAL_ASKED = bytes([0x40, 0x18, 0x10, 4, 0, 0, 0, 0])
POSITION_TOLD = bytes([0x43, 0x64, 0x60, 0, 0x39, 0x30, 0, 0])
POSITION = 0x3039
WRITTEN = b"\x60"


def few_bits(data: bytes, random: Random) -> bytes:
    wrong = sum(1 << bit for bit in random.sample(range(8 * len(data)), random.randint(1, 3)))
    return (int.from_bytes(data) ^ wrong).to_bytes(len(data))


def burst(data: bytes, random: Random) -> bytes:
    wrong = random.randint(1, 0xFFFF) << random.randrange(8 * len(data) - 15)
    return (int.from_bytes(data) ^ wrong).to_bytes(len(data))


def cut(data: bytes, random: Random) -> bytes:
    return data[: random.randrange(len(data))]


def noise(data: bytes, random: Random) -> bytes:
    return random.randbytes(len(data))


KINDS: list[Callable[[bytes, Random], bytes]] = [few_bits, burst, cut, noise]


def daq_frames(count: int, random: Random) -> bool:
    """Frames of the DAQ through the codec; whether all went well."""
    frames = DaqFrames.from_file()
    accepted: Counter[str] = Counter()
    slowest_s, began_s = 0.0, time.perf_counter()
    for i in range(count):
        can_id, data = frames.encode_voltage(random.uniform(-20.0, 20.0), i, i // 256 % 256)
        kind = random.choice(KINDS)
        spoilt = kind(data, random)
        asked_s = time.perf_counter()
        frame = frames.decode(can_id, spoilt)
        slowest_s = max(slowest_s, time.perf_counter() - asked_s)
        accepted[kind.__name__] += frame is not None and spoilt != data
    _tell("CAN DAQ, codec", count, began_s, slowest_s, accepted)
    certain = sum(accepted[kind.__name__] for kind in (few_bits, burst, cut))
    return not certain and slowest_s < SLOW_S


def frames_to_drive(count: int, random: Random) -> bool:
    """Frames to the emulated drive; whether it answered every time it was asked and stayed within its limits."""
    channel = "endurance"
    world = SharedWorld(build(Simulated(), clock=VirtualClock()))
    drive = EmulatedDrive(world, channel)
    low_deg, high_deg = world.head.limits_deg
    good, slowest_s, began_s = True, 0.0, time.perf_counter()
    with can.Bus(interface="virtual", channel=channel) as bus:
        for i in range(count):
            _send(bus, *_spoilt_request(random))
            if i % CHECKED_EVERY == 0:
                asked_s = time.perf_counter()
                good &= _answers(bus)
                slowest_s = max(slowest_s, time.perf_counter() - asked_s)
                with world.lock:
                    world.clock.sleep(0.5)
                    good &= low_deg <= world.head.status().angle_deg <= high_deg
    drive.close()
    _tell(f"CiA 402, to the drive, asked {count // CHECKED_EVERY} times", count, began_s, slowest_s, Counter())
    return good and slowest_s < 10 * SLOW_S


def _spoilt_request(random: Random) -> tuple[int, bytes]:
    """An SDO request, a PDO, an NMT command or an emergency of the drive's own, with an error."""
    index = random.choice([*range(0x1000, 0x1020), *range(0x6040, 0x60A0), 0x1400, 0x1600, 0x1800, 0x1A00])
    request = bytes([random.choice([0x40, 0x23, 0x2B, 0x2F, 0x60, 0x00])]) + index.to_bytes(2, "little")
    can_id = random.choice([0x601] * 6 + [0x201, 0x301, 0x000, 0x081, 0x701])
    data = random.choice(KINDS)(request + random.randbytes(5), random)
    return can_id, data[:2] if can_id == 0 else data


def _send(bus: can.BusABC, can_id: int, data: bytes) -> None:
    bus.send(can.Message(arbitration_id=can_id, data=data, is_extended_id=False))


def _answers(bus: can.BusABC) -> bool:
    """Whether the drive, once it has worked off what was sent, tells its serial number."""
    _send(bus, 0x601, SERIAL_ASKED)
    deadline_s = time.monotonic() + 10 * SLOW_S
    while time.monotonic() < deadline_s:
        message = bus.recv(0.1)
        if message and message.arbitration_id == 0x581 and bytes(message.data[:4]) == b"\x43\x18\x10\x04":
            return True
    return False


class LyingLink:
    """Fits `CanLink` as far as a node uses it: answers every SDO request at once, with an error."""

    def __init__(self, random: Random) -> None:
        self._random = random
        self.generation = 1
        self.kind = ""
        self.answers = 0

    def subscribe(self, listener: Callable[[can.Message], None]) -> None:
        """Take the one who listens."""
        self._listener = listener

    def send(self, can_id: int, data: bytes) -> None:
        """Hear a request, and answer it wrongly."""
        if can_id == 0x601 and data[0] != 0x80:
            kind = self._random.choice(KINDS)
            self.kind = kind.__name__
            self.answers += 1
            right = WRITTEN + data[1:4] + bytes(4) if data[0] & 0xE0 == 0x20 else POSITION_TOLD
            self._listener(can.Message(arbitration_id=0x581, data=kind(right, self._random)))

    def check(self) -> None:
        """Be there."""

    def reopen(self, generation: int) -> int:
        """Be as it was."""
        return generation


def frames_to_master(count: int, random: Random) -> bool:
    """Answers to the driver, which reads the position and sets the mode; whether each was taken or told as an error."""
    master.REPLY_TIMEOUT_S, master._LATE_S = 0.001, 0.0
    link = LyingLink(random)
    node = DriveNode(link, 1)
    accepted: Counter[str] = Counter()
    slowest_s, began_s = 0.0, time.perf_counter()
    while link.answers < count:
        asked_s = time.perf_counter()
        try:
            wrong = node.read(objects.POSITION) != POSITION
            accepted[link.kind] += wrong
            node.write(objects.MODE, 1)
        except DeviceError:
            pass
        slowest_s = max(slowest_s, time.perf_counter() - asked_s)
    _tell("CiA 402, to the driver", link.answers, began_s, slowest_s, accepted)
    return slowest_s < SLOW_S


def _tell(what: str, count: int, began_s: float, slowest_s: float, accepted: Counter[str]) -> None:
    taken_s = time.perf_counter() - began_s
    print(f"{what}: {count} frames in {taken_s:.0f} s, slowest {1e3 * slowest_s:.1f} ms, accepted {dict(accepted)}")


def main() -> int:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else FRAMES
    logging.disable(logging.CRITICAL)
    random = Random(1)
    good = [daq_frames(count, random), frames_to_drive(count // 2, random), frames_to_master(count // 2, random)]
    print("good" if all(good) else "bad")
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
