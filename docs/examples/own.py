"""Effects of a laboratory's own, in the place of `effects/own.py`: the heat of a reading lamp."""

from collections.abc import Sequence

from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.tracing.effect import Effect, Form, plain, single


def _lit(scene: Scene) -> Sequence[Form]:
    """The table's column `lamp`, 1 where the lamp is lit; nothing where there is none."""
    column = scene.observations.extra.get("lamp")
    return () if column is None else single(column.astype(float))


LAMP: Effect[Scene] = Effect(
    name="lamp",
    belongs_to="stand",
    symbol="k_l · lamp",
    source="heat of the reading lamp",
    forms=_lit,
    report=plain("lamp", "V"),
    depends_on="order",
)

OWN_EFFECTS: tuple[Effect[Scene], ...] = (LAMP,)
