"""The catalogue: every physical effect that a residual can be traced to.

- `effect.Effect`: how one is declared.
- `scene.Scene`: what it may depend on.
- `unit`, `stand`, `daq`: the effects that are known, by what they belong to.
- `own`: where a laboratory adds its own, a few lines each.
- `CATALOGUE`: all of them.
"""

from tumble.calibrations.methods.dividing_head.effects.daq import DAQ_EFFECTS
from tumble.calibrations.methods.dividing_head.effects.own import OWN_EFFECTS
from tumble.calibrations.methods.dividing_head.effects.stand import STAND_EFFECTS
from tumble.calibrations.methods.dividing_head.effects.unit import UNIT_EFFECTS

CATALOGUE = (*UNIT_EFFECTS, *STAND_EFFECTS, *DAQ_EFFECTS, *OWN_EFFECTS)
"""All effects. Of two that explain the data equally well with as many coefficients, the first gives its name."""
