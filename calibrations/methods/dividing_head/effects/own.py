"""Effects of a laboratory's own. One is a few lines: name, owner, columns, what its coefficient is called.

Effect(
    name="lamp",
    belongs_to="stand",
    symbol="k_l · lamp",
    source="heat of the reading lamp",
    forms=lambda scene: single(scene.observations.extra.get("lamp")),
    report=plain("lamp", "V"),
)
"""

from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.tracing.effect import Effect

OWN_EFFECTS: tuple[Effect[Scene], ...] = ()
