"""Effects of a laboratory's own, in the place of `calibrations/effects/own.py`: the heat of a reading lamp."""

from tumble.calibrations.effects.effect import Effect, plain, single
from tumble.calibrations.effects.scene import Scene

LAMP: Effect[Scene] = Effect(
    name="lamp",
    belongs_to="stand",
    symbol="k_l · lamp",
    source="heat of the reading lamp",
    forms=lambda scene: single(scene.observations.extra.get("lamp")),  # a column of the table; 1: the lamp is lit
    report=plain("lamp", "V"),
    depends_on="order",
)

OWN_EFFECTS: tuple[Effect[Scene], ...] = (LAMP,)
