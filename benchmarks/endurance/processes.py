"""A run of `tumble` against `tumble emulate`, each in a process of its own."""

import json
import signal
import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

TUMBLE = (sys.executable, "-m", "tumble")
SOCKET = "socket://127.0.0.1:0"
BUS = "socketcand:can0?host=127.0.0.1&port=0"
WAIT_S = 20.0


@dataclass(frozen=True, kw_only=True)
class Instruments:
    """Drivers of head and DAQ, and where they are; a manual head, and what is simulated, is nowhere."""

    head: str
    daq: str
    head_url: str = ""
    daq_url: str = ""

    def at(self, addresses: Mapping[str, str], suffix: str = "") -> "Instruments":
        """The same at the addresses where `tumble emulate` serves them; `_pty` for its pseudo-terminals."""
        return replace(self, head_url=addresses.get(f"head{suffix}", ""), daq_url=addresses[f"daq{suffix}"])

    def write_stand(self, path: Path, simulated: str = "seed = 1") -> Path:
        """Write a stand file whose table `simulated` says this."""
        head_url = f'url = "{self.head_url}"\n' if self.head_url else ""
        daq_url = f'url = "{self.daq_url}"\n' if self.daq_url else ""
        path.write_text(
            f'name = "endurance"\n[head]\ndriver = "{self.head}"\n{head_url}limits_deg = [-180.0, 760.0]\n'
            f'[daq]\ndriver = "{self.daq}"\n{daq_url}[simulated]\n{simulated}\n',
            encoding="utf-8",
        )
        return path


SIMULATED = Instruments(head="simulated", daq="simulated")
ZABER_SCPI = Instruments(head="zaber", daq="scpi", head_url=SOCKET, daq_url=SOCKET)
ZABER_CAN = Instruments(head="zaber", daq="can", head_url=SOCKET, daq_url=BUS)
CIA402_SCPI = Instruments(head="cia402", daq="scpi", head_url=BUS, daq_url=SOCKET)
CIA402_CAN = Instruments(head="cia402", daq="can", head_url=BUS, daq_url=BUS)
MANUAL_SCPI = Instruments(head="manual", daq="scpi", daq_url=SOCKET)


@contextmanager
def emulated(stand: Path, speed: float, *options: str) -> Iterator[dict[str, str]]:
    """Emulate the stand of a file; gives the addresses."""
    command = [*TUMBLE, "emulate", "--stand", str(stand), "--speed", f"{speed:g}", *options]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout
        try:
            addresses: dict[str, str] = json.loads(process.stdout.readline())
            yield addresses
        finally:
            process.send_signal(signal.SIGINT)
            process.wait(WAIT_S)


def run(stand: Path, programme: str, recording: Path) -> None:
    """Run a programme on a stand. Raises `RuntimeError` with what it complained of."""
    command = [*TUMBLE, "run", "--stand", str(stand), "--programme", programme]
    command += ["--serial", "endurance", "--out", str(recording)]
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    if ran.returncode:
        raise RuntimeError(f"{recording.stem}: {ran.stderr.strip()}")
