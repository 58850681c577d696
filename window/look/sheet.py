"""What palette and font do not say of the look of a window, as a style sheet of Qt."""

from typing import Final

from tumble.window.look.shades import CONTRAST, Colours
from tumble.window.look.tints import BLUE

_LOUD: Final = 1.3
"""How much larger STOP and the state are than other text."""
_SPACE_PX: Final = 4
"""Between parts at the usual size of text."""


def style_sheet(chosen: Colours, text_scale: float, point_size: float) -> str:
    """The sheet in some colours, for text of `text_scale` times `point_size`."""
    space, loud_pt = round(_SPACE_PX * text_scale), _LOUD * point_size * text_scale
    small_pt = point_size * text_scale
    return f"""
    QPushButton {{ padding: {space}px {3 * space}px; background: {chosen.button}; color: {chosen.ink};
        border: 1px solid {chosen.outline}; border-radius: {space}px; }}
    QPushButton:hover, QPushButton:focus {{ border-color: {chosen.accent}; }}
    QPushButton:pressed {{ background: {chosen.grid}; }}
    QPushButton:disabled {{ color: {chosen.disabled}; border-color: {chosen.grid}; }}
    QLineEdit, QComboBox, QDateEdit {{ padding: {space // 2}px {space}px; }}
    QLineEdit {{ border: 1px solid {chosen.pale}; border-radius: 3px; }}
    QComboBox:disabled, QCheckBox:disabled {{ color: {chosen.disabled}; }}
    QLineEdit:focus, QComboBox:focus {{ border: 2px solid {chosen.accent}; border-radius: 3px; }}
    QPushButton#stop {{ background: #B71C1C; color: white; font-weight: bold; font-size: {loud_pt}pt;
        border: 2px solid #7F0000; border-radius: {space}px; padding: {space}px {4 * space}px; }}
    QPushButton#stop:hover {{ background: #D32F2F; }}
    QPushButton#primary {{ font-weight: bold; border: 2px solid {chosen.accent}; border-radius: {space}px; }}
    QPushButton#primary:disabled {{ border-color: {chosen.grid}; }}
    QToolButton#rail {{ border: 1px solid transparent; border-radius: {space}px; padding: {space // 2}px;
        background: transparent; color: {chosen.ink}; font-size: {small_pt}pt; }}
    QToolButton#rail:hover, QToolButton#rail:focus {{ border-color: {chosen.accent}; }}
    QToolButton#rail:checked {{ background: {chosen.accent}; color: {chosen.paper}; }}
    QFrame#card {{ background: {chosen.paper}; border: 1px solid {chosen.grid}; border-radius: {2 * space}px; }}
    QFrame#over, QFrame#notice_fault {{ background: {chosen.paper}; border-radius: {2 * space}px; }}
    QFrame#over {{ border: 2px solid {chosen.accent}; }}
    QFrame#notice_fault {{ border: 2px solid {chosen.bad}; }}
    QLabel#state {{ font-weight: bold; font-size: {loud_pt}pt; }}
    QLabel#fault {{ font-weight: bold; font-size: {loud_pt}pt; color: {chosen.bad}; }}
    QFrame#question {{ background: {chosen.paper}; border: 3px solid {chosen.accent};
        border-radius: {2 * space}px; }}
    QPlainTextEdit#code, QLabel#code {{ font-family: monospace; }}
    QLabel#heading {{ font-weight: bold; }}
    QLabel#pale {{ color: {chosen.pale}; }}
    QLabel#good {{ color: {chosen.good}; font-weight: bold; }}
    QLabel#bad {{ color: {chosen.bad}; font-weight: bold; }}
    QCheckBox::indicator {{ border: {max(1, space // 4)}px solid {chosen.pale}; background: {chosen.paper};
        width: {3 * space}px; height: {3 * space}px; }}
    QCheckBox::indicator:checked {{ background: {chosen.accent}; }}
    QCheckBox::indicator:disabled {{ border-color: {chosen.grid}; }}
    QTabWidget::pane {{ border: 1px solid {chosen.grid}; }}
    QTabBar::tab {{ padding: {space}px {2 * space}px; color: {chosen.ink}; border-bottom: 3px solid transparent; }}
    QTabBar::tab:selected {{ border-bottom-color: {chosen.accent}; font-weight: bold; }}
    QTabBar::tab:hover {{ border-bottom-color: {chosen.outline}; }}
    QTabBar::tab:disabled {{ color: {chosen.disabled}; }}
    """ + (_outlines(chosen) if chosen is CONTRAST else "")


def _outlines(chosen: Colours) -> str:
    """Edges of what would be black on black: the style paints them darker than the window."""
    return f"""
    QComboBox, QDateEdit, QTabWidget::pane, QTableWidget, QListWidget, QPlainTextEdit, QTextBrowser, QProgressBar
        {{ border: 1px solid {chosen.outline}; }}
    QProgressBar {{ text-align: center; color: {chosen.ink}; }}
    QProgressBar::chunk {{ background: {BLUE.ground}; }}
    QCheckBox::indicator {{ border: 2px solid {chosen.outline}; }}
    QSplitter::handle {{ background: {chosen.grid}; }}
    QToolTip {{ border: 1px solid {chosen.outline}; }}
    """
