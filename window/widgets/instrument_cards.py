"""The instruments of a stand, a card each, as many beside each other as have room."""

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QEvent, QSize
from PySide6.QtGui import QAction, QResizeEvent
from PySide6.QtWidgets import QGridLayout, QWidget

from tumble.app.stand import LoadedStand
from tumble.drivers.protocols import Block, Identity
from tumble.window.widgets.instrument_card import InstrumentCard
from tumble.window.widgets.live_value import LiveValue


class InstrumentCards(QWidget):
    """Asks for the width of its widest card, and for the height of its cards where they stand now.

    What is `offered` is in the menu of every card.
    """

    def __init__(self, offered: Sequence[QAction] = (), parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._offered = offered
        self.cards: dict[str, InstrumentCard] = {}
        """By name of the instrument."""
        self._identities: dict[str, Identity] = {}
        self._columns = 0
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setSizeConstraint(QGridLayout.SizeConstraint.SetNoConstraint)

    @property
    def live(self) -> Mapping[str, LiveValue]:
        """What samplers and environments read, by name."""
        return {name: card.live for name, card in self.cards.items() if card.live is not None}

    def show_stand(self, loaded: LoadedStand) -> None:
        """Show what the stand file says."""
        tables, reading = loaded.file.instruments, [*loaded.file.samplers, *loaded.file.environments]
        if (list(tables), set(reading)) != (list(self.cards), set(self.live)):
            self._make({name: name in reading for name in tables})
        for name, table in tables.items():
            self.cards[name].show_table(table)
        self.forget_identities()

    def show_identity(self, name: str, identity: Identity) -> None:
        """Show who answers as an instrument; one of another stand is passed over."""
        if name in self.cards:
            self._identities[name] = identity
            self.cards[name].show_identity(identity)

    def show_fault(self, name: str) -> None:
        """Show which instrument failed; one of another stand is passed over."""
        if name in self.cards:
            self.cards[name].show_fault()

    def forget_faults(self) -> None:
        """Show again who answers."""
        for name, card in self.cards.items():
            card.show_identity(self._identities.get(name))

    def forget_identities(self) -> None:
        """Nobody was asked."""
        self._identities.clear()
        self.forget_faults()
        for live in self.live.values():
            live.forget()

    def see(self, name: str, block: Block | None) -> None:
        """Show what a sampler or an environment reads; None where it gives nothing."""
        if name in self.live:
            self.live[name].see(block)

    def pause_readings(self) -> None:
        """Nothing is read for a while."""
        for live in self.live.values():
            live.pause()

    def minimumSizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """One card beside the other is a wish and no need."""
        return QSize(self._widest, self._grid.minimumSize().height())

    def sizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """The same."""
        return self.minimumSizeHint()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802  # Qt's name
        """Put as many beside each other as have room."""
        super().resizeEvent(event)
        self._arrange()

    def event(self, event: QEvent) -> bool:
        """Do so again where a card says something longer, or shorter."""
        if event.type() == QEvent.Type.LayoutRequest:
            self._arrange()
        return super().event(event)

    @property
    def _widest(self) -> int:
        return max((card.minimumSizeHint().width() for card in self.cards.values()), default=0)

    @property
    def _fitting(self) -> int:
        """How many cards have room beside each other, one at least."""
        gap = self._grid.horizontalSpacing()
        return max(1, min((self.width() + gap) // max(self._widest + gap, 1), len(self.cards)))

    def _make(self, reads: Mapping[str, bool]) -> None:
        """Have a card for each instrument, in place of those that are there; whether it reads something is said."""
        for card in self.cards.values():
            self._grid.removeWidget(card)
            card.hide()  # it is deleted when the event loop comes to it
            card.deleteLater()
        self.cards = {
            name: InstrumentCard(name, reads=reading, offered=self._offered) for name, reading in reads.items()
        }
        self._columns = 0
        self._arrange()

    def _arrange(self) -> None:
        if self._columns == self._fitting:
            return
        self._columns = self._fitting
        for column in range(max(self._grid.columnCount(), self._columns)):
            self._grid.setColumnStretch(column, 1 if column < self._columns else 0)
        for place, card in enumerate(self.cards.values()):
            self._grid.addWidget(card, *divmod(place, self._columns))
        self.updateGeometry()
