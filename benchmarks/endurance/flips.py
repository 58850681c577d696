"""A recording with one bit flipped: is the damage said, or does it change nothing?

`python -m benchmarks.endurance.flips [--structural 5000] [--header 1000]` records a `quick` run and flips single bits
of copies of it: in what holds the file together (magic, opcodes, lengths, chunk headers, indexes, counts, the end) and
in the header with the programme. A flip is silent where the copy is read as whole although it says something else than
was recorded. With `--recording` another file is flipped, for example one of an older format.
"""

import argparse
import random
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path

from mcap.opcode import Opcode

from tumble.app.cli import main as tumble
from tumble.procedures.recording.errors import RecordingError
from tumble.procedures.recording.frames import frames
from tumble.procedures.recording.reader import iter_samples, read_recording
from tumble.procedures.recording.recorded import Recording

HEADER = "header"
_SAYS = {Opcode.METADATA: HEADER, Opcode.ATTACHMENT: HEADER}
_CHUNK_HEAD = 8 + 8 + 8 + 4 + (4 + len("zstd")) + 8
"""Bytes of a chunk in front of its data (MCAP 1.0, "Chunk")."""


@dataclass(frozen=True, kw_only=True)
class Place:
    """Bytes of a recording that mean the same kind of thing."""

    kind: str
    begin: int
    end: int


def places(content: bytes) -> Iterator[Place]:
    """Every byte of a recording by what it is, the data of its chunks left out: each has a checksum of its own."""
    yield Place(kind="magic", begin=0, end=8)
    for frame in frames(BytesIO(content)):
        at = frame.place + len(frame.head)
        end = at + len(frame.body)
        yield Place(kind="opcode", begin=frame.place, end=frame.place + 1)
        yield Place(kind="length", begin=frame.place + 1, end=at)
        kind = _SAYS.get(Opcode(frame.opcode), Opcode(frame.opcode).name.lower())
        yield Place(kind=kind, begin=at, end=min(end, at + _CHUNK_HEAD) if frame.opcode == Opcode.CHUNK else end)
    yield Place(kind="magic", begin=len(content) - 8, end=len(content))


@dataclass(frozen=True, kw_only=True)
class Flipped:
    """What became of one flip."""

    kind: str
    place: int
    bit: int
    outcome: str
    """`refused`, `said` (as damaged or not complete), `harmless` (everything reads as it was) or `silent`."""


def said_by(path: Path) -> tuple[Recording, list[tuple[object, ...]]]:
    """All that a recording says, its samples too."""
    samples = [
        (each.point, each.time_s, each.block.rate_hz, each.block.voltage_v.tobytes()) for each in iter_samples(path)
    ]
    return read_recording(path), samples


def outcome(path: Path, whole: tuple[Recording, object]) -> str:
    """What reading a damaged copy of `whole`, at the path of which it lies, comes to."""
    try:
        recording = read_recording(path)
        if recording.damage or not recording.complete:
            return "said"
        return "harmless" if said_by(path) == whole else "silent"
    except RecordingError:
        return "refused"


def flips(recording: Path, structural: int, header: int, seed: int) -> Iterator[Flipped]:
    """Flip bits, each kind of place as often as the others, and look what reading says."""
    content, draw = recording.read_bytes(), random.Random(seed)
    by_kind: dict[str, list[Place]] = {}
    for place in places(content):
        by_kind.setdefault(place.kind, []).append(place)
    kinds = sorted(set(by_kind) - {HEADER})
    whole = said_by(recording)
    wanted = [*(kinds[number % len(kinds)] for number in range(structural)), *[HEADER] * header]
    with tempfile.TemporaryDirectory() as name:
        copy = Path(name) / recording.name
        for kind in wanted:
            found = draw.choice([place for place in by_kind[kind] if place.end > place.begin])
            place, bit = draw.randrange(found.begin, found.end), draw.randrange(8)
            damaged = bytearray(content)
            damaged[place] ^= 1 << bit
            copy.write_bytes(damaged)
            same = (_at(whole[0], copy), whole[1])
            yield Flipped(kind=kind, place=place, bit=bit, outcome=outcome(copy, same))


def _at(recording: Recording, path: Path) -> Recording:
    return Recording(**{**vars(recording), "path": path})


def recorded(folder: Path) -> Path:
    """Record a `quick` run."""
    path = folder / "whole.mcap"
    sys.argv = ["tumble", "run", "--programme", "quick", "--serial", "flips", "--out", str(path)]
    tumble()
    return path


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--structural", type=int, default=5000)
    parser.add_argument("--header", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--recording", type=Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        recording = options.recording or recorded(Path(name))
        done = list(flips(recording, options.structural, options.header, options.seed))
    for kind in dict.fromkeys(each.kind for each in done):
        counted = Counter(each.outcome for each in done if each.kind == kind)
        print(f"{kind:16s} {', '.join(f'{number} {outcome}' for outcome, number in sorted(counted.items()))}")
    silent = [each for each in done if each.outcome == "silent"]
    print(f"{len(done)} flips: {len(silent)} silent")
    if silent:
        sys.exit(f"for example {silent[:5]}")


if __name__ == "__main__":
    main()
