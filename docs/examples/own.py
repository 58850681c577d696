"""Effects of a laboratory's own, in the place of `calibrations/effects/own.py`: the heat of a reading lamp."""

from collections.abc import Sequence

from tumble.calibrations.effects.effect import Effect, Form, plain, single
from tumble.calibrations.effects.scene import Scene


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
