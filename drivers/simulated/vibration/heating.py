"""What the power of the drive leaves behind: `tau ẋ = ½ level² - x`, exact between two changes of the drive."""

import math
from dataclasses import dataclass

import numpy as np

from tumble.drivers.excitation import Excitation, Random, Sines
from tumble.drivers.simulated.geometry import FloatArray


def power_g2(excitation: Excitation) -> float:
    """Mean square of the drive; a centrifuge needs none that heats."""
    match excitation:
        case Sines(tones=tones):
            return sum(0.5 * tone.level_g**2 for tone in tones)
        case Random():
            return excitation.rms_g**2
        case _:
            return 0.0


def level_g(excitation: Excitation) -> float:
    """Level of the drive as its pick-up goes: peak of sines, r.m.s. of random vibration."""
    match excitation:
        case Sines(tones=tones):
            return max(tone.level_g for tone in tones)
        case Random():
            return excitation.rms_g
        case _:
            return 0.0


@dataclass(kw_only=True)
class Heat:
    """The state x, in g², at a moment, and what it goes towards from then."""

    tau_s: float
    since_s: float = 0.0
    x_g2: float = 0.0
    power_g2: float = 0.0

    def at(self, times_s: FloatArray) -> FloatArray:
        """The state at times from the last change on."""
        decay = np.exp(-(times_s - self.since_s) / self.tau_s)
        return np.asarray(self.power_g2 + (self.x_g2 - self.power_g2) * decay)

    def change(self, now_s: float, power_g2: float) -> None:
        """Go towards another power from now on."""
        decay = math.exp(-(now_s - self.since_s) / self.tau_s)
        self.x_g2 = self.power_g2 + (self.x_g2 - self.power_g2) * decay
        self.since_s, self.power_g2 = now_s, power_g2
