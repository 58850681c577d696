"""An emulated stand in this process, reached by the real drivers through loopback sockets, whose clock runs faster."""

from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Final, Literal

from tumble.app.running import Job
from tumble.app.stand import LoadedStand, load_stand
from tumble.app.wiring import Connected, connect
from tumble.drivers.simulated import HeadOptions, Simulated, build
from tumble.emulators.emulation import Wanted, emulate
from tumble.emulators.scpi.models import Messages
from tumble.emulators.speed import FasterClock
from tumble.emulators.stand_faults import StandFaults
from tumble.emulators.world import SharedWorld
from tumble.procedures.programmes import programme_from_text

Pair = Literal["serial", "CAN", "plain meter", "Keithley 2000"]
"""Zaber and a multimeter, or a CiA 402 drive and a CAN DAQ on one bus; or Zaber and a meter that takes one query a
message, or a Keithley 2000."""

SPEED_DEG_S: Final = 60.0
SAMPLES: Final = 50
_METERS: Final[dict[Pair, tuple[str, Messages]]] = {
    "plain meter": ("34461A", "first"),
    "Keithley 2000": ("MODEL 2000", "any"),
}
_SERIAL: Final = ("zaber", "scpi")
_DRIVERS: Final[dict[Pair, tuple[str, str]]] = {
    "serial": _SERIAL,
    "CAN": ("cia402", "can"),
    "plain meter": _SERIAL,
    "Keithley 2000": _SERIAL,
}
_ANYWHERE: Final[dict[Pair, dict[str, str]]] = {
    pair: dict.fromkeys(("head", "daq"), "virtual:anywhere" if pair == "CAN" else "socket://127.0.0.1:0")
    for pair in _DRIVERS
}
"""Addresses of a stand that is not served yet."""


class StandClock(FasterClock):
    """The clock of an emulated stand, whose wall time somebody may set."""

    set_by_s = 0.0
    """What was added to the wall time."""

    def wall_ns(self) -> int:
        """The wall time as it was set."""
        return super().wall_ns() + round(self.set_by_s * 1e9)


@dataclass(frozen=True, kw_only=True)
class EmulatedStand:
    """A stand being served, and what is to be measured there."""

    job: Job
    clock: StandClock
    speed: float
    """Times real time."""
    shared: SharedWorld
    faults: StandFaults

    def connect(self) -> Connected:
        """Connect the real drivers. Raises `DeviceError`."""
        return connect(self.job.stand, clock=self.clock)


@contextmanager
def emulated(
    folder: Path, pair: Pair, programme: str, speed: float, settings: Simulated | None = None
) -> Iterator[EmulatedStand]:
    """Serve a stand while the context lasts.

    Parameters
    ----------
    folder
        Where its stand file is written.
    pair
        Which instruments.
    programme
        Text of what is to be measured.
    speed
        Times real time.
    settings
        The simulated world.
    """
    clock = StandClock(speed)
    built = build(settings or Simulated(seed=3), clock=clock, head=HeadOptions(speed_deg_s=SPEED_DEG_S))
    shared = SharedWorld(built)
    faults = StandFaults(None, clock, lambda: built.world.counts.dwells)
    anywhere = _stand(folder, pair, _ANYWHERE[pair])
    meter, messages = _METERS.get(pair, ("34461A", "any"))
    wanted = Wanted(head=anywhere.file.head, daq=anywhere.file.daq, meter=meter, meter_messages=messages)
    with ExitStack() as stack:
        where = emulate(stack, shared, wanted, faults)
        stand = _stand(folder, pair, where)
        job = Job(stand=stand, programme=programme_from_text(programme, "faults"), serial_number="E-1")
        yield EmulatedStand(job=job, clock=clock, speed=speed, shared=shared, faults=faults)


def _stand(folder: Path, pair: Pair, where: Mapping[str, str]) -> LoadedStand:
    """The stand whose instruments have these addresses."""
    head, daq = _DRIVERS[pair]
    file = folder / "stand.toml"
    file.write_text(
        f'name = "emulated"\n[head]\ndriver = "{head}"\nurl = "{where["head"]}"\nlimits_deg = [-180.0, 760.0]\n'
        f'speed_deg_s = {SPEED_DEG_S}\n[daq]\ndriver = "{daq}"\nurl = "{where["daq"]}"\nsamples = {SAMPLES}\n'
        "[simulated]\n"
    )
    return load_stand(file)
