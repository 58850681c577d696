"""Zaber ASCII frames with errors through the codec: `python -m benchmarks.endurance.zaber_frames [FRAMES]`.

Every frame is a right one with one kind of error. It must be refused, or mean what it meant. The checksum is a sum: it
sees every error within one byte and every cut, but two errors may cancel. What then passes is counted apart, as the
protocol's own weakness, and only where the checksum of the changed bytes is right; it is never the codec's doing.
"""

import sys
import time
from collections import Counter
from collections.abc import Callable
from random import Random

from tumble.drivers.zaber.codec import DeviceMessage, GarbledError, Kind, encode_message, lrc, parse_message

FRAMES = 1_000_000
SLOW_S = 0.1
"""A frame that takes longer has hung, on whatever machine."""


def one_bit(line: bytes, random: Random) -> bytes:
    place = random.randrange(len(line) - 2)
    return line[:place] + bytes([line[place] ^ 1 << random.randrange(8)]) + line[place + 1 :]


def one_byte(line: bytes, random: Random) -> bytes:
    place = random.randrange(len(line) - 2)
    return line[:place] + random.randbytes(1) + line[place + 1 :]


def cut(line: bytes, random: Random) -> bytes:
    return line[: random.randrange(len(line) - 2)] + b"\r\n"


def beheaded(line: bytes, random: Random) -> bytes:
    return line[random.randrange(1, len(line)) :]


def byte_lost(line: bytes, random: Random) -> bytes:
    place = random.randrange(len(line) - 2)
    return line[:place] + line[place + 1 :]


def byte_put_in(line: bytes, random: Random) -> bytes:
    place = random.randrange(len(line) - 2)
    return line[:place] + random.randbytes(1) + line[place:]


def burst(line: bytes, random: Random) -> bytes:
    place = random.randrange(len(line) - 2)
    noise = random.randbytes(random.randrange(2, 9))
    return (line[:place] + noise + line[place + len(noise) :]).rstrip(b"\r\n") + b"\r\n"


def two_swapped(line: bytes, random: Random) -> bytes:
    place = random.randrange(len(line) - 3)
    return line[:place] + line[place + 1 : place + 2] + line[place : place + 1] + line[place + 2 :]


def two_merged(line: bytes, random: Random) -> bytes:
    other = encode_message(frame(random), checksum=True)
    return line[: random.randrange(1, len(line) - 2)] + other[random.randrange(1, len(other) - 2) :]


ERRORS: tuple[Callable[[bytes, Random], bytes], ...] = (
    one_bit,
    one_byte,
    cut,
    beheaded,
    byte_lost,
    byte_put_in,
    burst,
    two_swapped,
    two_merged,
)


def frame(random: Random) -> DeviceMessage:
    """A reply as a stage sends it, an alert or an info now and then."""
    kind = random.choices((Kind.REPLY, Kind.ALERT, Kind.INFO), (8, 1, 1))[0]
    return DeviceMessage(
        kind=kind,
        device=random.randrange(1, 100),
        axis=random.randrange(10),
        message_id=None if kind is Kind.ALERT else random.randrange(100),
        accepted=kind is not Kind.REPLY or random.random() < 0.9,
        busy=kind is not Kind.INFO and random.random() < 0.5,
        warning="--" if kind is Kind.INFO else random.choice(("--", "FS", "WR", "WH", "NI")),
        data=random.choice((str(random.randrange(-800_000, 800_000)), "0", "BADDATA", "02 WR WH")),
    )


def fate(message: DeviceMessage, spoilt: bytes) -> str:
    """What the codec makes of a spoilt frame."""
    try:
        read = parse_message(spoilt, checksum=True)
    except GarbledError:
        return "refused"
    if read == message:
        return "means the same"
    text, _, footer = spoilt.strip(b"\r\n").partition(b":")
    return "unseen by the checksum" if footer == b"%02X" % lrc(text[1:]) else "ACCEPTED THOUGH WRONG"


def main(frames: int = FRAMES) -> int:
    random, fates, longest_s = Random(1), Counter[tuple[str, str]](), 0.0
    began_s = time.perf_counter()
    for number in range(frames):
        message, error = frame(random), ERRORS[number % len(ERRORS)]
        spoilt = error(encode_message(message, checksum=True), random)
        frame_s = time.perf_counter()
        fates[error.__name__, fate(message, spoilt)] += 1
        longest_s = max(longest_s, time.perf_counter() - frame_s)
    for (error_name, what), count in sorted(fates.items()):
        print(f"{error_name:12} {what:24} {count:8}")
    wrong = sum(count for (_, what), count in fates.items() if what.isupper())
    unseen = sum(count for (_, what), count in fates.items() if what.startswith("unseen"))
    print(f"{frames} frames in {time.perf_counter() - began_s:.0f} s, longest {1e3 * longest_s:.2f} ms;")
    print(f"{wrong} accepted though the checksum was wrong, {unseen} that the checksum cannot tell from right ones")
    return 1 if wrong or longest_s > SLOW_S else 0


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else FRAMES))
