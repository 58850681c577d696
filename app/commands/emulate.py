"""`tumble emulate`: serve the simulated world of a stand file through the protocols of real instruments."""

import json
import signal
import sys
import threading
from contextlib import ExitStack
from pathlib import Path
from urllib.parse import urlsplit

import click

from app.commands import options
from app.running import STOPPING_SIGNALS
from app.simulation import simulation
from app.stand import load_stand
from drivers.links.places import LOOPBACK, one_host
from drivers.simulated import SimulatedStand
from drivers.tables import Instrument, OnCan
from emulators.emulation import Wanted, emulate
from emulators.faults import FaultScript
from emulators.speed import FasterClock
from emulators.stand_faults import StandFaults
from emulators.world import SharedWorld
from procedures.errors import InputError
from procedures.toml_lines import parse_toml, read_text


@click.command("emulate")
@options.stand
@click.option(
    "--head-port", type=click.IntRange(0, 65535), help="TCP port of the head; without, that of the stand file."
)
@click.option("--daq-port", type=click.IntRange(0, 65535), help="TCP port of the DAQ; without, that of the stand file.")
@click.option("--pty", "ptys", is_flag=True, help="Serve on pseudo-terminals too.")
@click.option(
    "--speed",
    default=1.0,
    show_default=True,
    type=click.FloatRange(min=1e-3),
    callback=options.finite,
    help="Times real time.",
)
@click.option("--faults", "script", type=options.EXISTING, help="What goes wrong, and when (TOML).")
def command(
    stand_path: Path | None,
    head_port: int | None,
    daq_port: int | None,
    ptys: bool,
    speed: float,
    script: Path | None,
) -> None:
    """Serve the simulated world of a stand until stopped.

    The first line on standard output says where, as JSON.
    """
    loaded = load_stand(stand_path)
    head, daq = loaded.file.head, loaded.file.daq
    clock = FasterClock(speed)
    wanted = Wanted(
        head=head,
        daq=daq,
        head_port=_port(head) if head_port is None else head_port,
        daq_port=_port(daq) if daq_port is None else daq_port,
        folder=loaded.folder,
        ptys=ptys,
    )
    simulated = simulation(loaded, clock)
    shared = SharedWorld(SimulatedStand(stand=simulated.stand, world=simulated.world))
    faults = StandFaults(_read(script), clock, lambda: simulated.world.counts.dwells)
    with ExitStack() as stack:
        try:
            addresses = emulate(stack, shared, wanted, faults)
        except ValueError as error:
            raise InputError(f"{loaded.path}: {error}") from error
        except OSError as error:
            raise InputError(f"the emulated stand cannot be served ({error}); choose other ports") from error
        click.echo(json.dumps(addresses))
        sys.stdout.flush()
        _until_stopped()


def _port(table: Instrument) -> int:
    """The TCP port of an instrument's address on this computer; 0, any, where it has none."""
    if isinstance(table, OnCan):
        served, options = table.bus.interface == "socketcand", table.bus.options
        host, port = str(options.get("host", "")), int(options.get("port", 0))
    else:
        place = urlsplit(table.url)
        served, host, port = place.scheme == "socket", place.hostname or "", place.port or 0
    return port if served and one_host(host) == LOOPBACK else 0


def _read(path: Path | None) -> FaultScript | None:
    return None if path is None else parse_toml(read_text(path), FaultScript, str(path))


def _until_stopped() -> None:
    """Wait to be told to stop, in short waits: on Windows a long one is not interrupted."""
    stopped = threading.Event()
    for number in STOPPING_SIGNALS:
        signal.signal(number, lambda *_: stopped.set())
    while not stopped.wait(0.2):
        pass
