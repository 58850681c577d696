"""The catalogue of a triad: effects of the unit, of the stand and of the voltmeter."""

from typing import Final

from tumble.calibrations.methods.triad.effects.daq import DAQ_EFFECTS
from tumble.calibrations.methods.triad.effects.stand import STAND_EFFECTS
from tumble.calibrations.methods.triad.effects.unit import UNIT_EFFECTS
from tumble.calibrations.methods.triad.scene import TriadScene
from tumble.calibrations.tracing.effect import Effect

TRIAD_EFFECTS: Final[tuple[Effect[TriadScene], ...]] = (*UNIT_EFFECTS, *STAND_EFFECTS, *DAQ_EFFECTS)
