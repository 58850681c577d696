"""Where every positioner of a stand is: a dial for each."""

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QHBoxLayout, QLabel, QVBoxLayout, QWidget

from tumble.drivers.protocols import PositionerStatus
from tumble.window.look.names import instrument_name
from tumble.window.widgets.dial import Dial


class Dials(QWidget):
    """Dials beside each other; a single one fills the place and needs no name."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._dials: dict[str, Dial] = {}
        self._row = QHBoxLayout(self)
        self._row.setContentsMargins(0, 0, 0, 0)

    def show_positioners(self, names: Sequence[str]) -> None:
        """Show a dial for each of them, which all point nowhere."""
        if tuple(names) != tuple(self._dials):
            self._make(names)
        for dial in self._dials.values():
            dial.show_status(None)

    def show_status(self, name: str, status: PositionerStatus) -> None:
        """Show where a positioner is; one that is none of the stand is passed over."""
        if name in self._dials:
            self._dials[name].show_status(status)

    def of(self, name: str) -> Dial:
        """The dial of a positioner."""
        return self._dials[name]

    def _make(self, names: Sequence[str]) -> None:
        while (item := self._row.takeAt(0)) is not None:
            if (before := item.widget()) is not None:
                before.hide()  # it is deleted when the event loop comes to it
                before.deleteLater()
        self._dials = {name: Dial() for name in names}
        for name, dial in self._dials.items():
            self._row.addWidget(_named(name, dial) if len(names) > 1 else dial)


def _named(name: str, dial: Dial) -> QWidget:
    both, title = QWidget(), QLabel(instrument_name(name))
    title.setTextFormat(Qt.TextFormat.PlainText)
    title.setAlignment(Qt.AlignmentFlag.AlignHCenter)
    column = QVBoxLayout(both)
    column.setContentsMargins(0, 0, 0, 0)
    column.addWidget(title)
    column.addWidget(dial, stretch=1)
    return both
