"""What one model of multimeter can do and another cannot, from their data sheets."""

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Model:
    """Timing of DC voltage readings."""

    nplc: tuple[float, ...]
    """Integration times that can be chosen, in power-line cycles, rising."""
    timer: bool
    """Whether it has a sample timer (`SAMP:SOUR TIM`); without one, readings are paced by the trigger delay."""
    memory: int
    """How many readings are kept until they are fetched."""


SLOWEST = Model(nplc=(0.02, 0.2, 1.0, 10.0, 100.0), timer=False, memory=1_000)
"""What every model of the family can do."""

MODELS: Mapping[str, Model] = {
    "34460A": SLOWEST,
    "34461A": Model(nplc=(0.02, 0.2, 1.0, 10.0, 100.0), timer=False, memory=10_000),
    "34465A": Model(nplc=(0.02, 0.06, 0.2, 1.0, 10.0, 100.0), timer=True, memory=50_000),
    "34470A": Model(nplc=(0.02, 0.06, 0.2, 1.0, 10.0, 100.0), timer=True, memory=50_000),
    "34410A": Model(nplc=(0.006, 0.02, 0.06, 0.2, 1.0, 2.0, 10.0, 100.0), timer=True, memory=50_000),
    "34411A": Model(nplc=(0.001, 0.002, 0.006, 0.02, 0.06, 0.2, 1.0, 2.0, 10.0, 100.0), timer=True, memory=1_000_000),
}
