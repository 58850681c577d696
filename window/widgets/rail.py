"""The way from screen to screen: a sign for each, and a badge where something there wants to be seen."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from PySide6.QtCore import QEvent, QPointF, QSize, Qt, Signal
from PySide6.QtGui import QActionGroup, QColor, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QToolButton, QVBoxLayout, QWidget

from tumble.window.look.icons import icon
from tumble.window.look.keys import KeyedAction, key_text
from tumble.window.look.shades import Colours
from tumble.window.look.theme import colours
from tumble.window.look.tints import Tint
from tumble.window.widgets.splitter import NARROW_LINES

_LINES: Final = 1.7
"""Height of a sign in lines of text."""
_LINES_ALONE: Final = 1.25
"""The same where there is no room for titles."""
_LEAST_PX: Final = 16
"""The same where there is least room."""
_BADGE: Final = 0.36
"""Radius of a badge, at most, in parts of the sign that it stands at."""
_LEAST_BUTTON_PX: Final = 28
"""Height of a button then."""
_AROUND_PX: Final = 20
"""Above, between and below six of them."""


@dataclass(frozen=True, kw_only=True)
class Place:
    """A screen as the rail shows it."""

    sign: str
    """Name of its picture."""
    title: str
    usual_key: str
    is_apart: bool = False
    """Whether it stands at the foot of the rail, by its sign alone."""


@dataclass(frozen=True, kw_only=True)
class Badge:
    """What is to be seen of a screen from every other one."""

    sign: str
    """One or two letters."""
    tint: Tint
    meaning: str
    """The same in words, for the tooltip and for whoever is read to."""


class RailButton(QToolButton):
    """Sign, title, and a badge in its corner."""

    def __init__(self, place: Place, action: KeyedAction, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._place = place
        self._painted_in: Colours | None = None
        self.badge: Badge | None = None
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setDefaultAction(action)
        self.setObjectName("rail")
        self._recolour()
        self.wear(None)

    def name_it(self) -> None:
        """Show its title below its sign."""
        style = Qt.ToolButtonStyle
        self.setToolButtonStyle(style.ToolButtonIconOnly if self._place.is_apart else style.ToolButtonTextUnderIcon)
        self._size_sign(round(_LINES * self.fontMetrics().height()))

    def show_sign(self, height: int) -> None:
        """Show its sign alone, as large as a height allows."""
        self.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonIconOnly)
        around = self.sizeHint().height() - self.iconSize().height()
        self._size_sign(max(_LEAST_PX, min(height - around, round(_LINES_ALONE * self.fontMetrics().height()))))

    def _size_sign(self, edge: int) -> None:
        self.setIconSize(QSize(edge, edge))

    def wear(self, badge: Badge | None) -> None:
        """Show another badge, or none."""
        self.badge = badge
        said = f"{self._place.title}: {badge.meaning}" if badge else self._place.title
        self.setAccessibleName(said)
        self.setToolTip(f"{said}  [{key_text(self._place.usual_key)}]")
        self.update()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802  # Qt's name
        """Take over another palette."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and self.defaultAction() is not None:
            self._recolour()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802  # Qt's name
        """Draw the badge over the button."""
        super().paintEvent(event)
        if self.badge is None:
            return
        painter, radius = QPainter(self), min(0.55 * self.fontMetrics().height(), _BADGE * self.iconSize().width())
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QColor(colours(self).paper))
        painter.setBrush(QColor(self.badge.tint.ground))
        across = min((self.width() + self.iconSize().width()) / 2, self.width() - radius - 2)
        centre = QPointF(across, radius + 3)
        painter.drawEllipse(centre, radius, radius)
        font = self.font()
        font.setBold(True)
        font.setPixelSize(max(8, round(radius * (1.3 if len(self.badge.sign) < 2 else 1.05))))
        painter.setFont(font)
        painter.setPen(QColor(self.badge.tint.ink))
        box = self.rect()
        box.setSize(QSize(round(2 * radius), round(2 * radius)))
        box.moveCenter(centre.toPoint())
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, self.badge.sign)

    def _recolour(self) -> None:
        chosen = colours(self)
        if chosen is not self._painted_in:
            self._painted_in = chosen
            self.defaultAction().setIcon(icon(self._place.sign, chosen.ink, chosen.paper))


class Rail(QWidget):
    """One button for each screen, one below the other, each with a key."""

    chosen = Signal(int)

    def __init__(self, places: Sequence[Place], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._group = QActionGroup(self)
        self.buttons: list[RailButton] = []
        column = QVBoxLayout(self)
        column.setContentsMargins(4, 4, 0, 4)
        column.setSpacing(2)
        for number, place in enumerate(places):
            if place.is_apart and not places[number - 1].is_apart:
                column.addStretch(1)
            self._add(place, column)
        self._name_them()
        column.setSizeConstraint(QVBoxLayout.SizeConstraint.SetNoConstraint)
        self.buttons[0].defaultAction().setChecked(True)

    def minimumSizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """As high as the least signs alone, and as wide as what is shown."""
        return QSize(self._needed().width(), _LEAST_BUTTON_PX * len(self.buttons) + _AROUND_PX)

    def sizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """As large as what is shown."""
        return self._needed()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802  # Qt's name
        """Leave out the titles where they have no room."""
        super().resizeEvent(event)
        self._name_them()

    @property
    def current(self) -> int:
        """Number of the screen that is shown, from 0."""
        return self._group.actions().index(self._group.checkedAction())

    def choose(self, number: int) -> None:
        """Show a screen; the first one where there is none of this number."""
        actions = self._group.actions()
        actions[number if 0 <= number < len(actions) else 0].trigger()

    def wear(self, number: int, badge: Badge | None) -> None:
        """Show a badge at a screen, or none."""
        self.buttons[number].wear(badge)

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802  # Qt's name
        """Grow with the text."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange and self.buttons:
            self._name_them()

    def fold(self) -> None:
        """Leave out the titles where the window is narrow for its text."""
        self._name_them()

    def _name_them(self) -> None:
        for button in self.buttons:
            button.name_it()
        narrow = self.window().width() < NARROW_LINES * self.fontMetrics().height()
        if narrow or self._needed().height() > self.height():
            for button in self.buttons:
                button.show_sign((self.height() - _AROUND_PX) // len(self.buttons))
        self.updateGeometry()

    def _needed(self) -> QSize:
        layout = self.layout()
        assert layout is not None, "the rail has a column of buttons"
        return layout.minimumSize()

    def _add(self, place: Place, column: QVBoxLayout) -> None:
        action, number = KeyedAction(place.title, place.usual_key, self), len(self.buttons)
        action.setCheckable(True)
        action.triggered.connect(lambda: self.chosen.emit(number))
        self._group.addAction(action)
        self.addAction(action)
        button = RailButton(place, action)
        self.buttons.append(button)
        column.addWidget(button)
