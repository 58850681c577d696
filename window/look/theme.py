"""Colours that every reader can tell apart, light and dark, and text that can grow.

Data colours are those of Okabe and Ito 2008, as in the reports; a shape or a word always goes with a colour.
"""

from dataclasses import dataclass
from enum import StrEnum
from typing import Final

from PySide6.QtGui import QColor, QFont, QPalette
from PySide6.QtWidgets import QApplication, QWidget

DATA: Final = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
MARKERS: Final = ("o", "s", "t1", "d", "t", "p")
"""Shapes of pyqtgraph beside the colours."""
POINT_SIZE: Final = 10.5
"""Of usual text."""
_STYLE: Final = "fusion"
_HALF: Final = 128
_LOUD: Final = 1.3
"""How much larger STOP and the state are than other text."""


class Shade(StrEnum):
    """Light, dark, or as the desktop is."""

    DESKTOP = "desktop"
    LIGHT = "light"
    DARK = "dark"


@dataclass(frozen=True, kw_only=True)
class Colours:
    """What is painted by hand."""

    paper: str
    ink: str
    pale: str
    """What is less important, yet readable."""
    grid: str
    accent: str
    """Done, measured, chosen."""
    now: str
    """Where the run is."""
    bad: str
    good: str
    data: tuple[str, ...]


LIGHT: Final = Colours(
    paper="#FFFFFF",
    ink="#1B222C",
    pale="#5B6573",
    grid="#D9DEE5",
    accent="#0072B2",
    now="#C24E00",
    bad="#A61B1B",
    good="#00664A",
    data=DATA,
)
DARK: Final = Colours(
    paper="#1B1F26",
    ink="#E8ECF2",
    pale="#A3ADBA",
    grid="#3A424E",
    accent="#56B4E9",
    now="#F0A030",
    bad="#FF8A80",
    good="#4FD1A5",
    data=("#56B4E9", "#F07A2A", "#2FC79A", "#E39BC4", "#F2B632", "#8CCBF2"),
)


def colours(widget: QWidget) -> Colours:
    """The colours that go with the palette of a widget."""
    return DARK if is_dark(widget.palette()) else LIGHT


def is_dark(palette: QPalette) -> bool:
    """Whether a palette has light text on dark."""
    return palette.color(QPalette.ColorRole.Window).lightness() < _HALF


def dress(application: QApplication, shade: Shade, text_scale: float) -> None:
    """Give every window its colours and its size of text; what is so already is left alone."""
    if application.style().name() != _STYLE:
        application.setStyle(_STYLE)
    dark = shade is Shade.DARK or (shade is Shade.DESKTOP and is_dark(application.style().standardPalette()))
    application.setPalette(_palette(DARK if dark else LIGHT, dark))
    font = QFont(application.font())
    font.setPointSizeF(POINT_SIZE * text_scale)
    if font != application.font():
        application.setFont(font)


def dress_window(window: QWidget, text_scale: float) -> None:
    """Give a window what palette and font do not say, in the colours that were chosen.

    All at once, when its parts are in their places: each of them would be dressed anew with every move.
    """
    chosen = DARK if is_dark(QApplication.palette()) else LIGHT
    window.setStyleSheet(_sheet(chosen, round(4 * text_scale), _LOUD * POINT_SIZE * text_scale))


def _palette(chosen: Colours, dark: bool) -> QPalette:
    role = QPalette.ColorRole
    window, button = ("#14171C", "#2A303A") if dark else ("#F2F4F7", "#E6EAEF")
    palette = QPalette()
    for which, colour in {
        role.Window: window,
        role.WindowText: chosen.ink,
        role.Base: chosen.paper,
        role.AlternateBase: "#222730" if dark else "#F6F8FA",
        role.Text: chosen.ink,
        role.Button: button,
        role.ButtonText: chosen.ink,
        role.ToolTipBase: chosen.paper,
        role.ToolTipText: chosen.ink,
        role.PlaceholderText: chosen.pale,
        role.Highlight: "#1F6FA8" if dark else chosen.accent,
        role.HighlightedText: "#FFFFFF",
        role.Link: chosen.accent,
    }.items():
        palette.setColor(which, QColor(colour))
    for which in (role.WindowText, role.Text, role.ButtonText):
        palette.setColor(QPalette.ColorGroup.Disabled, which, QColor("#79828E" if dark else "#7C8591"))
    return palette


def _sheet(chosen: Colours, space: int, loud_pt: float) -> str:
    return f"""
    QPushButton {{ padding: {space}px {3 * space}px; }}
    QLineEdit, QComboBox, QDateEdit {{ padding: {space // 2}px {space}px; }}
    QLineEdit {{ border: 1px solid {chosen.pale}; border-radius: 3px; }}
    QLineEdit:focus, QComboBox:focus {{ border: 2px solid {chosen.accent}; border-radius: 3px; }}
    QPushButton#stop {{ background: #B71C1C; color: white; font-weight: bold; font-size: {loud_pt}pt;
        border: 2px solid #7F0000; border-radius: {space}px; padding: {space}px {4 * space}px; }}
    QPushButton#stop:hover {{ background: #D32F2F; }}
    QPushButton#primary {{ font-weight: bold; border: 2px solid {chosen.accent}; border-radius: {space}px; }}
    QPushButton#primary:disabled {{ border-color: {chosen.grid}; }}
    QPushButton#navigation {{ border: none; border-radius: {space}px; padding: {2 * space}px {4 * space}px;
        text-align: left; background: transparent; }}
    QPushButton#navigation:hover, QPushButton#navigation:focus {{ border: 1px solid {chosen.accent}; }}
    QPushButton#navigation:checked {{ background: {chosen.accent}; color: {chosen.paper}; }}
    QFrame#card {{ background: {chosen.paper}; border: 1px solid {chosen.grid}; border-radius: {2 * space}px; }}
    QLabel#state {{ font-weight: bold; font-size: {loud_pt}pt; }}
    QLabel#fault {{ font-weight: bold; font-size: {loud_pt}pt; color: {chosen.bad}; }}
    QFrame#fault, QFrame#question {{ background: {chosen.paper}; border-radius: {2 * space}px; }}
    QFrame#fault {{ border: 3px solid {chosen.bad}; }}
    QFrame#question {{ border: 3px solid {chosen.accent}; }}
    QLabel#heading {{ font-weight: bold; }}
    QLabel#pale {{ color: {chosen.pale}; }}
    QLabel#good {{ color: {chosen.good}; font-weight: bold; }}
    QLabel#bad {{ color: {chosen.bad}; font-weight: bold; }}
    """
