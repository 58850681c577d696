"""`tumble emulate`: serve the simulated world of a stand file through the protocols of real instruments."""

import json
import time
from contextlib import ExitStack
from pathlib import Path
from urllib.parse import urlsplit

import click

from tumble.app.commands import options
from tumble.app.simulation import simulation
from tumble.app.stand import read_stand
from tumble.app.terminal import say
from tumble.drivers.links.places import LOOPBACK, one_host
from tumble.drivers.tables import DAQ, HEAD, Instrument, OnCan
from tumble.emulators.emulation import Wanted, emulate
from tumble.emulators.faults import FaultScript
from tumble.emulators.speed import FasterClock
from tumble.emulators.stand_faults import StandFaults
from tumble.emulators.world import SharedWorld
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.procedures.toml_lines import parse_toml, read_text


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
    loaded = read_stand(stand_path)
    if loaded.file.simulated is None:
        raise InputError(
            Message(
                "{path}: has no table [simulated], so that it is no stand to be emulated; add one", path=loaded.path
            )
        )
    file = loaded.file
    clock = FasterClock(speed)
    asked = {HEAD: head_port, DAQ: daq_port}
    ports = {name: _port(table) for name, table in file.instruments.items()}
    wanted = Wanted(
        positioners=file.positioners,
        samplers=file.samplers,
        chamber=file.chamber_table,
        exciter=file.exciter_table,
        ports=ports | {name: port for name, port in asked.items() if port is not None},
        folder=loaded.folder,
        ptys=ptys,
    )
    simulated = simulation(loaded, clock)
    shared = SharedWorld(simulated)
    faults = StandFaults(_read(script), clock, lambda: simulated.world.counts.dwells)
    with ExitStack() as stack:
        try:
            addresses = emulate(stack, shared, wanted, faults)
        except ValueError as error:
            raise InputError(Message("{path}: {error}", path=loaded.path, error=error)) from error
        except OSError as error:
            remedy = Message("choose other ports") if error.filename is None else Message("make room for it there")
            raise InputError(
                Message("the emulated stand cannot be served ({error}); {remedy}", error=error, remedy=remedy)
            ) from error
        say(json.dumps(addresses))
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
    """Wait to be interrupted, in short waits: on Windows a long one is not."""
    while True:
        time.sleep(0.2)
