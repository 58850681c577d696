"""How far the marks that are painted by hand stand out from what they are painted on: dials, pictures, plots.

A mark is what hangs together in one colour that carries a meaning, as a letter, a line or a point of a plot; its
ground is the colour that is most frequent close around it. Both are measured on what is painted.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final, TypeAlias

import numpy as np
import pyqtgraph as pg
from numpy.typing import NDArray
from PySide6.QtCore import QPoint
from PySide6.QtGui import QImage, QRegion
from PySide6.QtSvgWidgets import QSvgWidget
from PySide6.QtWidgets import QAbstractButton, QWidget
from scipy import ndimage

from benchmarks.window_flaws import LEAST_CONTRAST, SHARPNESS, contrast, ground_of
from tumble.window.look.shades import Colours
from tumble.window.look.theme import colours

Mask: TypeAlias = NDArray[np.bool_]
_SMALLEST_PX: Final = 4 * SHARPNESS
"""Area; what is smaller are pixels between two colours that happen to have a third."""
_BLEND_PX: Final = SHARPNESS
"""Around a mark, where its colour fades into that of its ground."""
_AROUND_PX: Final = 2 * SHARPNESS
_EVERY_NEIGHBOUR: Final = np.ones((3, 3), dtype=bool)


@dataclass(frozen=True, kw_only=True)
class Mark:
    """One letter, line or point: its colour and its ground, as 0xRRGGBB."""

    colour: int
    ground: int

    @property
    def contrast(self) -> float:
        """How far it stands out."""
        return float(contrast(self.colour, self.ground))


def faint_marks(window: QWidget) -> list[str]:
    """The marks that stand out by less than 4.5 : 1, of all that is shown and painted by hand."""
    return [
        f"{mark.contrast:.2f} : 1: #{mark.colour:06X} on #{mark.ground:06X} in {type(part).__name__}"
        for part in window.findChildren(QWidget)
        if _is_painted_by_hand(part) and _is_seen(part)
        for mark in marks(part)
        if mark.contrast < LEAST_CONTRAST
    ]


def marks(part: QWidget, painted_in: Colours | None = None) -> Iterator[Mark]:
    """The marks of a part, in the colours that carry a meaning where it is, unless it has others."""
    chosen, pixels = painted_in or colours(part), _painted(part)
    for name in {chosen.ink, chosen.pale, chosen.accent, chosen.now, chosen.bad, chosen.good, *chosen.data}:
        colour = int(name.removeprefix("#"), 16)
        painted = pixels == colour
        if not painted.any():
            continue
        labels, _ = ndimage.label(painted, _EVERY_NEIGHBOUR)
        for number, place in enumerate(ndimage.find_objects(labels), 1):
            wide = tuple(slice(max(side.start - _AROUND_PX, 0), side.stop + _AROUND_PX) for side in place)
            mask = labels[wide] == number
            if mask.sum() >= _SMALLEST_PX and (around := _around(mask, pixels[wide])).size:
                found, counts = np.unique(around, return_counts=True)
                yield Mark(colour=colour, ground=int(found[counts.argmax()]))


def _is_seen(part: QWidget) -> bool:
    painted = part.viewport() if isinstance(part, pg.PlotWidget) else part
    return part.isVisible() and not painted.visibleRegion().isEmpty()


def _is_painted_by_hand(part: QWidget) -> bool:
    if isinstance(part, QAbstractButton):
        return False
    own = type(part).__module__.startswith("tumble.") and "paintEvent" in vars(type(part))
    return own or isinstance(part, pg.PlotWidget | QSvgWidget)


def _painted(part: QWidget) -> NDArray[np.uint32]:
    image = QImage(part.size() * SHARPNESS, QImage.Format.Format_RGB32)
    image.setDevicePixelRatio(SHARPNESS)
    image.fill(ground_of(part))
    QWidget.render(part, image, QPoint(), QRegion(), QWidget.RenderFlag.DrawChildren)
    return np.frombuffer(image.constBits(), np.uint32).reshape(image.height(), image.width()) & np.uint32(0xFFFFFF)


def _around(mask: Mask, pixels: NDArray[np.uint32]) -> NDArray[np.uint32]:
    """The pixels close to a mark, without those in which it fades and others of its colour."""
    near = ndimage.binary_dilation(mask, _EVERY_NEIGHBOUR, _BLEND_PX)
    far = ndimage.binary_dilation(near, _EVERY_NEIGHBOUR, _AROUND_PX - _BLEND_PX)
    around = pixels[far & ~near]
    return around[around != pixels[mask][0]]
