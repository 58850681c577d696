"""What is not identifiable from a head table, whatever is found in it, each with the measurement that would help."""

from collections.abc import Iterator

import numpy as np

from tumble.calibrations.methods.head_reference.scene import HeadScene
from tumble.calibrations.methods.head_reference.settings import Settings
from tumble.messages import Message

SHORT_DEG = 170.0
"""On a shorter arc what happens once a turn is not distinguishable from a slope and a bend."""

_SIDE = 0.2
"""Part of the rows that must come from either side: single moves back to the start are none."""


def limits(scene: HeadScene, settings: Settings) -> tuple[str, ...]:
    """All of it, in sentences."""
    return (*_repeats(settings), *confounded(scene))


def confounded(scene: HeadScene) -> tuple[str, ...]:
    """What the angles and directions that were visited do not separate."""
    return (*_sides(scene), *_arc(scene))


def _repeats(settings: Settings) -> Iterator[str]:
    if settings.streamed:
        yield Message(
            "The rows are samples of a moving head, none of them a repeat of another: slips are held against their "
            "neighbours in time, and what nothing explains is taken for noise, the weaker test."
        )
    elif not settings.repeated:
        yield Message(
            "No setting was visited twice from the same side: slips are held against the settings beside them, and "
            "what nothing explains is taken for noise, the weaker test; visit every setting again."
        )


def _sides(scene: HeadScene) -> Iterator[str]:
    """Where each angle was reached from one side, and both sides occur."""
    sides = [np.count_nonzero(scene.direction == sign) for sign in (1, -1)]
    if min(sides) >= _SIDE * scene.rows and not scene.both_ways:
        yield Message(
            "Each part of the arc was visited in one direction only, so that backlash and the shape of the error are "
            "the same rows and not distinguishable; visit some angles from both sides."
        )


def _arc(scene: HeadScene) -> Iterator[str]:
    if scene.arc_deg < SHORT_DEG:
        yield Message(
            "The settings span {arc_deg:.0f}° of the circle: what happens once a turn, or less than twice in that "
            "arc, is not identifiable; visit the whole turn.",
            arc_deg=scene.arc_deg,
        )
