"""SCPI lines with errors through codec and emulator: `python -m benchmarks.endurance.scpi_frames [LINES]`.

Every line is a right one with one kind of error. An answer must be refused, or mean what it meant: SCPI has no
checksum, but the codec asks for everything twice. A message to the emulated multimeter may mean anything; the meter
must go on answering. Times are those of the slowest line, by the computer's clock.
"""

import sys
import time
from collections import Counter
from collections.abc import Callable
from random import Random

from tumble.drivers.clock import VirtualClock
from tumble.drivers.scpi.codec import CorruptReplyError, StaleReplyError, agreed, parse_readings, parse_reply, request
from tumble.drivers.simulated import Simulated, build
from tumble.emulators.scpi import Multimeter, ScpiSession
from tumble.emulators.world import SharedWorld

LINES = 1_000_000
SLOW_S = 1.0
"""A line that takes longer has hung, on whatever machine."""
CHECKED_EVERY = 1000
QUERIES = ["VOLT:DC:RANG?", "FETC?"]
MESSAGES = (
    b"*ESE 12;:ABOR;*CLS;:CONF:VOLT:DC;:VOLT:DC:RANG 10;:VOLT:DC:NPLC 0.2;:SAMP:COUN 5;:INIT;*ESE?;:FETC?;*ESE?\n",
    b"MEAS:VOLT:DC? DEF,DEF\n",
    b':SENS:FUNC "VOLT:DC";:SENS:VOLT:RANG:AUTO 0;UPP 100 mV;:READ?\n',
    b"TRIG:SOUR BUS;:SAMP:TIM 0.01;SOUR TIM;:INIT;*TRG;:FETCh?\n",
    b"SYSTem:ERRor:NEXT?;*ESR?;*STB?;*IDN?\n",
    b"CONF:TEMP FRTD,(@101);:READ?;:SAMP:TIM? MIN\n",
)


def one_bit(line: bytes, random: Random) -> bytes:
    place = random.randrange(len(line) - 1)
    return line[:place] + bytes([line[place] ^ 1 << random.randrange(8)]) + line[place + 1 :]


def cut(line: bytes, random: Random) -> bytes:
    return line[: random.randrange(len(line) - 1)] + b"\n"


def beheaded(line: bytes, random: Random) -> bytes:
    return line[random.randrange(1, len(line)) :]


def byte_lost(line: bytes, random: Random) -> bytes:
    place = random.randrange(len(line) - 1)
    return line[:place] + line[place + 1 :]


def byte_put_in(line: bytes, random: Random) -> bytes:
    place = random.randrange(len(line) - 1)
    return line[:place] + random.randbytes(1) + line[place:]


def burst(line: bytes, random: Random) -> bytes:
    place = random.randrange(len(line) - 1)
    noise = random.randbytes(random.randrange(1, 9))
    return (line[:place] + noise + line[place + len(noise) :]).rstrip(b"\n") + b"\n"


def part_twice(line: bytes, random: Random) -> bytes:
    begin, end = sorted(random.randrange(len(line)) for _ in range(2))
    return line[:end] + line[begin:]


def part_lost(line: bytes, random: Random) -> bytes:
    begin, end = sorted(random.randrange(len(line)) for _ in range(2))
    return line[:begin] + line[end:]


def two_swapped(line: bytes, random: Random) -> bytes:
    place = random.randrange(len(line) - 2)
    return line[:place] + line[place + 1 : place + 2] + line[place : place + 1] + line[place + 2 :]


ERRORS: tuple[Callable[[bytes, Random], bytes], ...] = (
    one_bit,
    cut,
    beheaded,
    byte_lost,
    byte_put_in,
    burst,
    part_twice,
    part_lost,
    two_swapped,
)


def answer(tag: int, random: Random) -> bytes:
    """What a meter answers to `QUERIES`, asked twice."""
    readings = ",".join(f"{random.gauss(2.5, 1.0):+.8E}" for _ in range(random.randrange(1, 6)))
    return f"+{tag};+1.00000000E+01;{readings};+1.00000000E+01;{readings};+{tag}\n".encode()


def verdict(spoilt: bytes, right: bytes, tag: int) -> str:
    """What the codec makes of a spoilt answer."""
    try:
        meant = agreed(parse_reply(spoilt, tag, 2 * len(QUERIES)))
        parse_readings(meant[-1])
    except StaleReplyError:
        return "taken for a late one"
    except CorruptReplyError:
        return "refused"
    return "unchanged" if meant == agreed(parse_reply(right, tag, 2 * len(QUERIES))) else "ACCEPTED"


def spoil_answers(lines: int, random: Random) -> tuple[Counter[str], float]:
    verdicts: Counter[str] = Counter()
    slowest_s = 0.0
    for count in range(lines):
        tag = random.randrange(1, 256)
        right = answer(tag, random)
        spoilt = ERRORS[count % len(ERRORS)](right, random)
        began_s = time.perf_counter()
        verdicts[verdict(spoilt, right, tag)] += 1
        slowest_s = max(slowest_s, time.perf_counter() - began_s)
    return verdicts, slowest_s


class Meter:
    """The emulated multimeter in virtual time."""

    def __init__(self) -> None:
        self._clock = VirtualClock()
        self._session = ScpiSession(Multimeter(SharedWorld(build(Simulated(), clock=self._clock))))

    def hear(self, line: bytes) -> bytes:
        """Answer, after an hour at the latest."""
        answered = self._session.received(line)
        if not answered:
            self._clock.sleep(3600.0)
            answered = self._session.due()
        return answered

    @property
    def alive(self) -> bool:
        """Whether it answers a right message rightly."""
        return parse_reply(self.hear(request(5, ["ABOR", "*CLS"], ["SYST:VERS?"])), 5, 1) == ("1994.0",)


def spoil_messages(lines: int, random: Random) -> tuple[Counter[str], float]:
    verdicts: Counter[str] = Counter()
    slowest_s = 0.0
    meter = Meter()
    for count in range(lines):
        spoilt = ERRORS[count % len(ERRORS)](random.choice(MESSAGES), random)
        began_s = time.perf_counter()
        verdicts["answered" if meter.hear(spoilt) else "silent"] += 1
        slowest_s = max(slowest_s, time.perf_counter() - began_s)
        if count % CHECKED_EVERY == 0 and not meter.alive:
            verdicts["DEAD"] += 1
    return verdicts, slowest_s


def main(lines: int = LINES) -> int:
    failed = False
    for what, spoil in (("answers to the codec", spoil_answers), ("messages to the meter", spoil_messages)):
        began_s = time.perf_counter()
        verdicts, slowest_s = spoil(lines, Random(1))
        lasted_s = time.perf_counter() - began_s
        counts = ", ".join(f"{count} {name}" for name, count in sorted(verdicts.items()))
        print(f"{lines} {what} in {lasted_s:.0f} s, the slowest {slowest_s * 1e3:.1f} ms: {counts}")
        failed |= bool(verdicts["ACCEPTED"] or verdicts["DEAD"] or slowest_s > SLOW_S)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
