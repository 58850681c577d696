"""Lists of positions for a triad: outer and inner angle, in degrees.

`24`, `18`, `12`, `6` and `24f` as inferred from the published counts; `16o`, `12o` and `8o` by exchange optimisation
of the mean variance over positions in steps of 45°.
"""

from collections.abc import Mapping
from typing import Final

Position = tuple[float, float]
_CIRCLE: Final = (-135.0, -90.0, -45.0, 0.0, 45.0, 90.0, 135.0, 180.0)
_OFF_FACES: Final = tuple(angle for angle in _CIRCLE if abs(angle) != 90.0)
_DIAGONAL: Final = (-135.0, -45.0, 45.0, 135.0)
_FACES: Final = (0.0, 90.0, 180.0, -90.0)

POSITIONS: Final[Mapping[str, tuple[Position, ...]]] = {
    "24": (
        *((90.0, inner) for inner in _CIRCLE),
        *((outer, 0.0) for outer in _CIRCLE),
        *((outer, 90.0) for outer in _CIRCLE),
    ),
    "18": (
        *((90.0, inner) for inner in _CIRCLE),
        *((outer, 0.0) for outer in _OFF_FACES),
        *((outer, 90.0) for outer in _DIAGONAL),
    ),
    "12": (
        *((90.0, inner) for inner in _DIAGONAL),
        *((outer, 0.0) for outer in _DIAGONAL),
        *((outer, 90.0) for outer in _DIAGONAL),
    ),
    "6": (*((90.0, inner) for inner in _FACES), (0.0, 0.0), (180.0, 0.0)),
    "24f": tuple((outer, inner) for outer in (90.0, 90.0, -90.0, -90.0, 0.0, 180.0) for inner in _FACES),
    "16o": (
        (-135.0, -135.0), (-135.0, 45.0), (-90.0, 0.0), (-90.0, 180.0), (-45.0, -45.0), (-45.0, 135.0),
        (0.0, -90.0), (0.0, 90.0), (45.0, -45.0), (45.0, 135.0), (90.0, -90.0), (90.0, 90.0),
        (135.0, -135.0), (135.0, 45.0), (180.0, -45.0), (180.0, 135.0),
    ),
    "12o": (
        (-135.0, 45.0), (-135.0, 135.0), (-90.0, -90.0), (-90.0, 0.0), (-45.0, 135.0), (0.0, -45.0),
        (45.0, 135.0), (90.0, -90.0), (90.0, 0.0), (135.0, 45.0), (135.0, 135.0), (180.0, -90.0),
    ),
    "8o": (
        (-135.0, -90.0), (-135.0, 45.0), (-90.0, 135.0), (-45.0, 0.0), (0.0, 180.0), (90.0, -135.0),
        (90.0, 0.0), (90.0, 90.0),
    ),
    "fine": tuple(
        (outer, inner) for outer in (30.0, 75.0, 105.0, 150.0) for inner in (-165.0, -105.0, -15.0, 45.0, 105.0)
    ),
}  # fmt: skip
"""By name; `fine` stands off the 45° grid, where periods that are ambiguous on it are told."""
