"""Recorders of other projects and ours, killed with SIGKILL: how many points can be read afterwards.

`python -m benchmarks.endurance.peers [--points 300]`. Each recorder runs as it comes, without a setting changed, in a
process of its own, which kills itself right after it has handed over the last point. Since some write only after a
number of seconds or bytes, this is done at two paces; the slower one ends in the middle between two writes of QCoDeS,
which writes every 5 s. POSIX only.
"""

import argparse
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import product
from pathlib import Path

from tumble.drivers.clock import SystemClock
from tumble.procedures.events import PointCompleted
from tumble.procedures.methods.dividing_head.rows import Row
from tumble.procedures.recording.header import Header
from tumble.procedures.recording.reader import read_recording
from tumble.procedures.recording.writer import Recorder
from tumble.procedures.steps import Point

POINTS = 300
PACES_S = (0.01, 0.11)


def angles_deg(points: int, pace_s: float) -> Iterator[float]:
    """Angles of so many points, one every `pace_s`; then the process is killed."""
    for index in range(points):
        time.sleep(pace_s)
        yield 5.0 * index
    os.kill(os.getpid(), signal.SIGKILL)


def record_qcodes(path: Path, given_deg: Iterator[float]) -> None:
    """QCoDeS' default dataset, in SQLite."""
    from qcodes.dataset import Measurement, initialise_or_create_database_at, load_or_create_experiment

    initialise_or_create_database_at(path)
    measurement = Measurement(exp=load_or_create_experiment("kills", "unit"))
    measurement.register_custom_parameter("angle")
    measurement.register_custom_parameter("voltage", setpoints=("angle",))
    with measurement.run() as saver:
        for angle_deg in given_deg:
            saver.add_result(("angle", angle_deg), ("voltage", 2.5))


def read_qcodes(path: Path) -> int:
    from qcodes.dataset import initialise_or_create_database_at, load_by_id

    initialise_or_create_database_at(path)
    return load_by_id(1).number_of_results


def record_pymeasure(path: Path, given_deg: Iterator[float]) -> None:
    """PyMeasure's results, a CSV file."""
    from pymeasure.experiment import Procedure, Results, Worker

    class Sweep(Procedure):
        DATA_COLUMNS = ("angle", "voltage")

        def execute(self) -> None:
            for angle_deg in given_deg:
                self.emit("results", {"angle": angle_deg, "voltage": 2.5})

    worker = Worker(Results(Sweep(), str(path)))
    worker.start()
    worker.join(timeout=3600)


def read_pymeasure(path: Path) -> int:
    lines = path.read_text("utf-8").splitlines()
    return sum(line[:1].isdigit() and len(line.split(",")) == 2 for line in lines)


def record_mcap(path: Path, given_deg: Iterator[float]) -> None:
    """A MCAP writer with chunks of its default size."""
    from mcap.writer import Writer

    with path.open("wb") as file:
        writer = Writer(file)
        writer.start()
        schema = writer.register_schema(name="point", encoding="jsonschema", data=b"{}")
        channel = writer.register_channel(topic="/point", message_encoding="json", schema_id=schema)
        for angle_deg in given_deg:
            data = f'{{"angle_deg":{angle_deg},"voltage_v":2.5}}'.encode()
            writer.add_message(channel, log_time=time.time_ns(), publish_time=time.time_ns(), data=data)


def read_mcap(path: Path) -> int:
    from mcap.exceptions import McapError
    from mcap.reader import NonSeekingReader

    count = 0
    with path.open("rb") as file:
        try:
            for _ in NonSeekingReader(file).iter_messages():
                count += 1
        except (McapError, EOFError):
            pass
    return count


def record_tumble(path: Path, given_deg: Iterator[float]) -> None:
    """The recorder of this project."""
    clock = SystemClock()
    recorder = Recorder(path, _header(clock), clock)
    for index, angle_deg in enumerate(given_deg):
        recorder.record(PointCompleted(point=_point(index, angle_deg)))


def read_tumble(path: Path) -> int:
    return len(read_recording(path).points)


def _header(clock: SystemClock) -> Header:
    texts = ("serial_number", "operator", "programme_text", "programme_sha256", "stand_path", "stand_sha256")
    return Header(
        **dict.fromkeys((*texts, "program_version", "git_commit"), ""),
        stand={},
        git_dirty=False,
        packages={},
        started_wall_ns=clock.wall_ns(),
        started_monotonic_s=clock.monotonic_s(),
    )


def _point(index: int, angle_deg: float) -> Point:
    row = Row(
        index=index,
        angle_deg=angle_deg,
        voltage_v=2.5,
        voltage_sd_v=1e-3,
        samples=100,
        time_s=float(index),
        direction=1,
        temperature_degc=None,
        realisation=1,
        procedure="sweep",
        mount="face-up",
        settled=True,
    )
    return row.point


@dataclass(frozen=True, kw_only=True)
class Peer:
    """A recorder: how it records, and how many points can be read."""

    name: str
    file: str
    record: Callable[[Path, Iterator[float]], None]
    read: Callable[[Path], int]


PEERS = {
    "qcodes": Peer(name="QCoDeS, default dataset", file="x.db", record=record_qcodes, read=read_qcodes),
    "pymeasure": Peer(name="PyMeasure, CSV results", file="x.csv", record=record_pymeasure, read=read_pymeasure),
    "mcap": Peer(name="MCAP, default chunks", file="x.mcap", record=record_mcap, read=read_mcap),
    "tumble": Peer(name="tumble", file="x.mcap", record=record_tumble, read=read_tumble),
}


def readable_after_kill(key: str, points: int, pace_s: float) -> int:
    """Record, die, and count what can be read."""
    command = [sys.executable, "-m", "benchmarks.endurance.peers", "--points", str(points), "--pace", str(pace_s)]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / PEERS[key].file
        died = subprocess.run([*command, "--record", key, str(path)], capture_output=True, text=True, check=False)
        if died.returncode != -signal.SIGKILL:
            raise RuntimeError(f"{key}: {died.stderr.strip()}")
        return PEERS[key].read(path)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--points", type=int, default=POINTS)
    parser.add_argument("--pace", type=float, default=PACES_S[0], help=argparse.SUPPRESS)
    parser.add_argument("--record", nargs=2, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.record:
        key, path = options.record
        PEERS[key].record(Path(path), angles_deg(options.points, options.pace))
        return 1
    cases = list(product(PEERS, PACES_S))
    with ThreadPoolExecutor(len(cases)) as pool:
        counts = pool.map(lambda case: readable_after_kill(case[0], options.points, case[1]), cases)
        read = dict(zip(cases, counts, strict=True))
    print(f"| recorder | {' | '.join(f'read of {options.points}, {pace_s:g} s a point' for pace_s in PACES_S)} |")
    print("|---|---|---|")
    for key, peer in PEERS.items():
        print(f"| {peer.name} | {' | '.join(str(read[key, pace_s]) for pace_s in PACES_S)} |")
    return 0 if all(read["tumble", pace_s] == options.points for pace_s in PACES_S) else 1


if __name__ == "__main__":
    sys.exit(main())
