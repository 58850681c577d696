"""What the person at the stand is asked: to set a condition, or to set and read a head."""

from collections.abc import Iterable

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLineEdit, QWidget

from tumble.drivers.manual import on_the_circle
from tumble.drivers.protocols import PositionerStatus
from tumble.procedures.layout import Layout
from tumble.procedures.steps import Ask
from tumble.window.look.language import tr
from tumble.window.look.names import instrument_name
from tumble.window.look.numbers import local
from tumble.window.look.sentences import in_language
from tumble.window.look.tints import AMBER
from tumble.window.widgets.huge_label import HugeLabel
from tumble.window.widgets.waiting_page import WaitingPage, answer_button


class ConditionPrompt(WaitingPage):
    """What is to be set, with a picture where there is one, and a button that no scanner can press.

    What moves the stand is free to move after it.
    """

    confirmed = Signal()

    def __init__(self, _: Layout, picture: QWidget | None = None, parent: QWidget | None = None) -> None:
        super().__init__(picture, parent)
        self._ask: Ask | None = None
        self._statuses: dict[str, PositionerStatus] = {}
        self.confirm = answer_button(self.button_text())
        self.confirm.clicked.connect(self.confirmed)
        self.column.addWidget(self.confirm)

    @property
    def value(self) -> str:
        """What the condition is to be."""
        return self._ask.value if self._ask else ""

    @property
    def statuses(self) -> dict[str, PositionerStatus]:
        """Where the positioners were seen last, by name."""
        return self._statuses

    def ask(self, ask: Ask) -> None:
        """Ask for a condition."""
        self._ask = ask
        self._say_it()

    def see(self, name: str, status: PositionerStatus) -> None:
        """A positioner was seen; what is to be done may depend on where it stands."""
        self._statuses[name] = status
        self._say_it()

    def forget(self) -> None:
        """Nobody knows where anything is."""
        self._statuses.clear()
        self._say_it()

    def instruction(self, ask: Ask) -> str:
        """What there is to do, and who turns what."""
        return " ".join(filter(None, (_sentence(in_language(ask.task)), *_who_turns(self._statuses.items()))))

    def button_text(self) -> str:
        """What the button says."""
        return tr("Done")

    def _say_it(self) -> None:
        if self._ask is not None:
            self.say(self.instruction(self._ask))


def _who_turns(statuses: Iterable[tuple[str, PositionerStatus]]) -> Iterable[str]:
    """Where positioners stand that know it, and whether the person has to turn them."""
    for positioner, status in statuses:
        name = instrument_name(positioner)
        here = angle_words(status)
        if not status.referenced:
            yield tr("{name}: angle not known.", name=name)
        elif status.by_hand:
            yield tr("{name} is at {here}: you turn it.", name=name, here=here)
        else:
            yield tr("{name} is at {here} and turns by itself once you confirm.", name=name, here=here)


def angle_words(status: PositionerStatus) -> str:
    """Where a positioner is, on the circle; whole degrees without minutes, and never broken between two lines."""
    return local(on_the_circle(status.angle_deg)).removesuffix(" 00′ 00″").replace(" ", "\u00a0")


def _sentence(text: str) -> str:
    return f"{text[:1].upper()}{text[1:]}."


class UnitPrompt(WaitingPage):
    """Asks for the next unit, where nothing else does that its programme begins with."""

    confirmed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent=parent)
        self.confirm = answer_button(tr("It is there"))
        self.confirm.clicked.connect(self.confirmed)
        self.column.addWidget(self.confirm)

    def ask(self, unit: str) -> None:
        """Ask for a unit, by the text that says which it is."""
        self.show_unit(unit)
        self.say(tr("Take the unit off the stand, and put {unit} in its place. It is measured at once.", unit=unit))


class ReadingPrompt(WaitingPage):
    """The next setting in huge digits, and a field for the reading: Enter alone says that the head stands as asked."""

    answered = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent=parent)
        self.setting = HugeLabel(AMBER.ink)
        self.setting.setMinimumHeight(110)
        self.field = QLineEdit()
        self.field.setPlaceholderText(tr("12 34 56, or 12.5"))
        self.field.setAccessibleName(tr("Reading of the head"))
        self.field.returnPressed.connect(self._answer)
        self._open = False
        font = self.field.font()
        font.setPointSizeF(font.pointSizeF() * 1.6)
        self.field.setFont(font)
        self.column.insertWidget(1, self.setting, stretch=1)
        self.column.addWidget(self.field)

    @property
    def prompt(self) -> str:
        """What is asked."""
        return self.words.text

    def ask(self, setting_deg: float, prompt: str) -> None:
        """Ask for a reading."""
        self.setting.say(local(on_the_circle(setting_deg)))
        self.say(in_language(prompt))
        self._open = True
        self.field.setFocus(Qt.FocusReason.OtherFocusReason)

    def _answer(self) -> None:
        """One answer to each question: a second Enter says nothing."""
        if not self._open:
            return
        text = self.field.text()
        self._open = False
        self.say(tr("Measuring…"))
        self.field.clear()
        self.answered.emit(text)
