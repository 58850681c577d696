"""The window in colours and in a size of text, both as they were chosen."""

from typing import Final

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QFont, QPalette
from PySide6.QtWidgets import QApplication, QWidget

from tumble.window.look.shades import CONTRAST, DARK, LIGHT, Colours, Shade
from tumble.window.look.sheet import style_sheet

POINT_SIZE: Final = 10.5
"""Of usual text."""
_STYLE: Final = "fusion"
_HALF: Final = 128
_BY_ACCENT: Final = {each.accent: each for each in (LIGHT, DARK, CONTRAST)}


def colours(widget: QWidget) -> Colours:
    """The colours that go with the palette of a widget."""
    return _colours_of(widget.palette())


def is_dark(palette: QPalette) -> bool:
    """Whether a palette has light text on dark."""
    return palette.color(QPalette.ColorRole.Window).lightness() < _HALF


def colours_of(application: QApplication, shade: Shade) -> Colours:
    """The colours of a choice; where that is the desktop's, by what the desktop says of itself."""
    if shade is not Shade.DESKTOP:
        return {Shade.LIGHT: LIGHT, Shade.DARK: DARK, Shade.CONTRAST: CONTRAST}[shade]
    told_dark = application.styleHints().colorScheme() is Qt.ColorScheme.Dark
    return DARK if told_dark or is_dark(application.style().standardPalette()) else LIGHT


def dress(application: QApplication, shade: Shade, text_scale: float) -> None:
    """Give every window its colours and its size of text; what is so already is left alone."""
    if application.style().name() != _STYLE:
        application.setStyle(_STYLE)
    application.setPalette(_palette(colours_of(application, shade)))
    font = QFont(application.font())
    font.setPointSizeF(POINT_SIZE * text_scale)
    if font != application.font():
        application.setFont(font)


def dress_window(window: QWidget, text_scale: float) -> None:
    """Give a window what palette and font do not say, in the colours that were chosen.

    All at once, when its parts are in their places: each of them would be dressed anew with every move.
    """
    window.setStyleSheet(style_sheet(_colours_of(QApplication.palette()), text_scale, POINT_SIZE))


def _colours_of(palette: QPalette) -> Colours:
    """By the colour of links, which no style sheet changes."""
    accent = palette.color(QPalette.ColorRole.Link).name().upper()
    return _BY_ACCENT.get(accent, DARK if is_dark(palette) else LIGHT)


def _palette(chosen: Colours) -> QPalette:
    role = QPalette.ColorRole
    palette = QPalette()
    for which, colour in {
        role.Window: chosen.window,
        role.WindowText: chosen.ink,
        role.Base: chosen.paper,
        role.AlternateBase: chosen.other_row,
        role.Text: chosen.ink,
        role.Button: chosen.button,
        role.ButtonText: chosen.ink,
        role.BrightText: chosen.ink,
        role.ToolTipBase: chosen.paper,
        role.ToolTipText: chosen.ink,
        role.PlaceholderText: chosen.pale,
        role.Highlight: chosen.highlight,
        role.HighlightedText: chosen.highlighted,
        role.Link: chosen.accent,
        role.LinkVisited: chosen.accent,
        role.Accent: chosen.highlight,
    }.items():
        palette.setColor(which, QColor(colour))
    for which in (role.WindowText, role.Text, role.ButtonText):
        palette.setColor(QPalette.ColorGroup.Disabled, which, QColor(chosen.disabled))
    return palette
