"""What changes between two visits to one setting of a head: drift and temperature, free of any error of the circle."""

from typing import Final

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.head_reference.effects import HEAD_EFFECTS, TIMED
from tumble.calibrations.methods.head_reference.scene import HeadScene
from tumble.calibrations.methods.head_reference.settings import Settings
from tumble.calibrations.methods.head_reference.shapes import HEAD_STRUCTURES
from tumble.calibrations.tracing.within import Within, lies_within, trace_within

_MOST_NUMBERS: Final = 5_000_000
"""A mean for each of so many settings of so many rows takes seconds; of longer tables the means alone are traced."""


def within_settings(scene: HeadScene, settings: Settings, error_deg: FloatArray) -> Within | None:
    """Trace what changes between repeats; None where settings were not visited again after some time."""
    if not settings.repeated or scene.hours is None or not lies_within(scene.hours, settings.number):
        return None
    if scene.rows * len(settings.visits) > _MOST_NUMBERS:
        return None
    effects = [effect for effect in HEAD_EFFECTS if effect.name in TIMED]
    structures = [shape for shape in HEAD_STRUCTURES if shape.depends_on == "time"]
    return trace_within(scene, settings.number, error_deg, "deg", effects, structures)
