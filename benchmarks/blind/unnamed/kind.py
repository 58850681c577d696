"""A kind of effect that no catalogue names: how its course is drawn, on what it acts, and what it depends on."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np

from benchmarks.blind.geometry import FloatArray
from benchmarks.blind.run import Run
from benchmarks.blind.sizing import Family, world_of
from benchmarks.blind.world import Acts, Effect, Unit, World

Course = Callable[[World, np.random.Generator], FloatArray]
"""Draws what an effect does at each row, in its own unit; the world is the one without effects."""

_ACTS: Final = {"offset": Acts.OUTPUT, "scale": Acts.OUTPUT, "angle": Acts.ANGLE}


@dataclass(frozen=True)
class Kind:
    """A kind: channel and variable are words of result.md."""

    channel: str
    variable: str
    course: Course
    designs: tuple[str, ...] = ("mounts", "all_mounts", "shuffled", "turns")
    """Designs that can show it for what it is."""
    also: tuple[str, ...] = ()
    """What else its course is a function of."""

    @property
    def name(self) -> str:
        """Name, for the report."""
        return self.course.__name__

    def drawn(self, run: Run, unit: Unit, rng: np.random.Generator) -> Family:
        """Draw its form for a run."""
        course = self.course(world_of(run, unit), rng)
        acts = _ACTS[self.channel]
        return lambda size: Effect(
            name=self.name,
            acts=acts,
            amount=lambda world: size * course * (world.ax if self.channel == "scale" else 1.0),
            coefficients={"size": size},
        )
