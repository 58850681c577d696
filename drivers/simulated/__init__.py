"""A simulated stand: its own physics, seen through the same interfaces as real instruments.

`Simulated` reads the `[simulated]` table, `build` makes the stand; `noise_free_voltage` answers without a run.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from numpy.typing import ArrayLike

from tumble.drivers.clock import Clock, VirtualClock
from tumble.drivers.protocols import Stand
from tumble.drivers.simulated.geometry import FloatArray
from tumble.drivers.simulated.head import HeadOptions
from tumble.drivers.simulated.settings import Simulated
from tumble.drivers.simulated.world import SimulatedWorld
from tumble.drivers.tables import DAQ, HEAD, TITLES

__all__ = ["HeadOptions", "Simulated", "SimulatedStand", "SimulatedWorld", "build", "noise_free_voltage"]


@dataclass(frozen=True, kw_only=True)
class SimulatedStand:
    """A stand as the engine sees it, and the world behind it, whose operator the caller plays."""

    stand: Stand
    world: SimulatedWorld


def build(
    settings: Simulated,
    *,
    name: str = "simulated",
    clock: Clock | None = None,
    head: HeadOptions | None = None,
    base_path: Path | None = None,
) -> SimulatedStand:
    """Make a simulated stand.

    Parameters
    ----------
    settings
        The `[simulated]` table of the stand file.
    name
        What the stand is called.
    clock
        Clock by which the world lives; a new virtual one by default.
    head
        Limits, counts and speed of the head.
    base_path
        Folder of the stand file, to which the files of external functions are relative; the working folder by default.

    Raises
    ------
    ValueError
        Where an external function cannot be loaded.
    """
    clock = clock or VirtualClock()
    world = SimulatedWorld(settings, clock=clock, head=head or HeadOptions(), base_path=base_path or Path())
    stand = Stand(name=name, positioners={HEAD: world.head}, samplers={DAQ: world.daq}, clock=clock, titles=TITLES)
    return SimulatedStand(stand=stand, world=world)


def noise_free_voltage(
    settings: Simulated, mounts: Sequence[str], angles_deg: ArrayLike, *, base_path: Path | None = None
) -> FloatArray:
    """Mean reading in V at each mount and reported angle, with static effects only; see `SimulatedWorld`."""
    return build(settings, base_path=base_path).world.noise_free_voltage(mounts, angles_deg)
