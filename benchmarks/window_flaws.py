"""What is wrong on a window: what a person would stumble on, found by looking at every part that is shown.

Wrong is a text that is cut off or in another language, a part that sticks out of its place, parts that lie on each
other, a page that has to be moved sideways, tabs that do not fit, a key that is underlined twice, and a text that is
too faint.
"""

from collections.abc import Iterator
from itertools import combinations

import numpy as np
from PySide6.QtCore import QPoint
from PySide6.QtGui import QColor, QImage, QKeySequence, QRegion
from PySide6.QtWidgets import (
    QAbstractButton,
    QComboBox,
    QFileDialog,
    QLabel,
    QLineEdit,
    QMenuBar,
    QScrollArea,
    QTabBar,
    QWidget,
)

from tumble.messages import Language, translate

LEAST_CONTRAST = 4.5
"""WCAG 2.1, 1.4.3."""
SHARPNESS = 3
"""Times larger than on screen: a stroke is then wide enough to have a pixel in its own colour."""
_EDGE_PX = 2
"""Width of what is drawn around a field or a button; it is no ground of letters."""


def flaws(window: QWidget, language: Language) -> list[str]:
    """What is wrong with the texts that are shown, a sentence each."""
    parts = list(_with_text(window))
    met = [(one, other) for one, other in combinations(parts, 2) if _meet(one, other)]
    return [
        *(f"cut off: {_named(part)}" for part in parts if _is_cut(part)),
        *(f"sticks out: {_named(part)}" for part in parts if _sticks_out(part)),
        *(f"on each other: {_named(one)} and {_named(other)}" for one, other in met),
        *_out_of_sight(window),
        *(f"not {language}: {_named(part)}" for part in parts if _is_foreign(part, language)),
        *(f"one key, {key}, for {' and '.join(texts)}" for key, texts in access_keys(window).items() if len(texts) > 1),
    ]


def _out_of_sight(window: QWidget) -> Iterator[str]:
    """What is there, and is seen only once somebody has moved it."""
    for area in window.findChildren(QScrollArea):
        if area.isVisible() and (hidden_px := area.horizontalScrollBar().maximum()) and not _is_of_qt(area):
            yield f"{hidden_px} px sideways: {type(area.widget()).__name__}"
    for bar in window.findChildren(QTabBar):
        if bar.isVisible() and not bar.rect().contains(bar.tabRect(bar.count() - 1)):
            yield f"no room for all tabs: {', '.join(bar.tabText(tab) for tab in range(bar.count()))}"


def access_keys(window: QWidget) -> dict[str, list[str]]:
    """The keys that are underlined, each with the texts that have it."""
    texts = [line.text() for menus in window.findChildren(QMenuBar) for line in menus.actions()]
    texts += [_text(part) for part in _with_text(window) if _has_access_key(part)]
    keyed = [(QKeySequence.mnemonic(text).toString(), text) for text in texts]
    return {key: [text for other, text in keyed if other == key] for key, _ in keyed if key}


def _has_access_key(part: QWidget) -> bool:
    return isinstance(part, QAbstractButton) or (isinstance(part, QLabel) and part.buddy() is not None)


def faint(window: QWidget) -> list[str]:
    """Texts that stand out from their ground by less than 4.5 : 1, measured on what is painted."""
    return [
        f"{stands_out:.2f} : 1: {_named(part)}"
        for part in _with_text(window)
        if (stands_out := painted_contrast(part)) < LEAST_CONTRAST
    ]


def painted_contrast(part: QWidget) -> float:
    """Contrast of the colour that is most frequent in a part, with the one that stands out most from it."""
    image = QImage(part.size() * SHARPNESS, QImage.Format.Format_RGB32)
    image.setDevicePixelRatio(SHARPNESS)
    image.fill(ground_of(part))
    part.render(image, QPoint(), QRegion(), QWidget.RenderFlag.DrawChildren)
    edge = _EDGE_PX * SHARPNESS
    colours, ground = _colours(image.copy(image.rect().adjusted(edge, edge, -edge, -edge)))
    return float(contrast(ground, colours).max())


def ground_of(part: QWidget) -> QColor:
    """What is painted behind a part, and around its letters, as its window shows it."""
    place = part.rect().translated(part.mapTo(part.window(), part.rect().topLeft()))
    return QColor(_colours(part.window().grab(place).toImage())[1])


def _colours(image: QImage) -> tuple[np.ndarray, int]:
    """The colours of an image, and the one that is most frequent."""
    pixels = np.frombuffer(image.convertToFormat(QImage.Format.Format_RGB32).constBits(), np.uint32)
    colours, counts = np.unique(pixels, return_counts=True)
    return colours, int(colours[counts.argmax()])


def contrast(one: int | np.ndarray, other: int | np.ndarray) -> np.ndarray:
    """Of colours, as 0xRRGGBB (WCAG 2.1, contrast ratio)."""
    first, second = _luminance(one), _luminance(other)
    return (np.maximum(first, second) + 0.05) / (np.minimum(first, second) + 0.05)


def _luminance(colours: int | np.ndarray) -> np.ndarray:
    """WCAG 2.1, relative luminance."""
    red, green, blue = ((np.asarray(colours) >> shift & 255) / 255 for shift in (16, 8, 0))
    parts = (np.where(part <= 0.03928, part / 12.92, ((part + 0.055) / 1.055) ** 2.4) for part in (red, green, blue))
    return sum(weight * part for weight, part in zip((0.2126, 0.7152, 0.0722), parts, strict=True))


def _with_text(window: QWidget) -> Iterator[QWidget]:
    """What is seen of labels, buttons and fields with a text; Qt's own dialogs are Qt's."""
    for part in window.findChildren(QWidget):
        if part.isVisible() and _text(part) and not part.visibleRegion().isEmpty() and not _is_of_qt(part):
            yield part


def _text(part: QWidget) -> str:
    match part:
        case QLabel() | QAbstractButton():
            return part.text()
        case QLineEdit():
            return part.text() or part.placeholderText()
        case QComboBox():
            return part.currentText()
    return ""


def _named(part: QWidget) -> str:
    return f"{type(part).__name__} “{_text(part)[:60]}”"


def _is_of_qt(part: QWidget) -> bool:
    parent: QWidget | None = part
    while parent is not None:
        if isinstance(parent, QFileDialog | QTabBar) or (isinstance(parent, QComboBox) and parent is not part):
            return True
        parent = parent.parentWidget()
    return False


def _is_cut(part: QWidget) -> bool:
    if isinstance(part, QLabel) and part.wordWrap():
        return part.heightForWidth(part.width()) > part.height() + 1
    if isinstance(part, QLineEdit):
        return part.fontMetrics().horizontalAdvance(_text(part)) > part.width() - 4
    if isinstance(part, QComboBox):
        return False  # elided, and whole in its list
    hint = part.sizeHint()
    return hint.width() > part.width() + 1 or hint.height() > part.height() + 1


def _sticks_out(part: QWidget) -> bool:
    parent = part.parentWidget()
    return parent is not None and not parent.rect().contains(part.geometry())


def _meet(one: QWidget, other: QWidget) -> bool:
    return one.parentWidget() is other.parentWidget() and one.geometry().intersects(other.geometry())


def _is_foreign(part: QWidget, language: Language) -> bool:
    text = _text(part)
    return translate(text, language) != text
