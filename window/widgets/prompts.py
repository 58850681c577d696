"""What the person at the stand is asked: to set a condition, or to set and read a head."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLineEdit, QVBoxLayout, QWidget

from tumble.drivers.manual import on_the_circle
from tumble.drivers.protocols import PositionerStatus
from tumble.procedures.layout import Layout
from tumble.procedures.steps import Ask
from tumble.window.look.language import tr
from tumble.window.look.numbers import local
from tumble.window.look.plain import PlainLabel
from tumble.window.look.sentences import in_language
from tumble.window.widgets.huge_label import HugeLabel
from tumble.window.widgets.motion_button import MotionButton


class ConditionPrompt(QFrame):
    """What is to be set by name, with a picture where there is one, and a button that no scanner can press.

    What moves the stand is free to move after it.
    """

    confirmed = Signal()

    def __init__(self, _: Layout, picture: QWidget | None = None, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("card")
        self._value = ""
        self._title = HugeLabel()
        self._title.setMaximumHeight(64)
        self._task = PlainLabel()
        self._task.setWordWrap(picture is None)
        self.confirm = MotionButton(self.button_text(), "F9")
        self.confirm.setObjectName("primary")
        self.confirm.clicked.connect(self.confirmed)
        layout = QVBoxLayout(self)
        layout.addWidget(self._title)
        layout.addWidget(picture or QWidget(), stretch=1)
        layout.addWidget(self._task)
        layout.addWidget(self.confirm)

    @property
    def value(self) -> str:
        """What the condition is to be."""
        return self._value

    def ask(self, ask: Ask) -> None:
        """Ask for a condition."""
        self._value = ask.value
        self._title.say(self.title(ask))
        self._task.setText(self.task(ask))

    def see(self, name: str, status: PositionerStatus) -> None:
        """A positioner was seen; what is asked for may depend on where it stands."""

    def title(self, ask: Ask) -> str:
        """What is asked for in a word or two, large."""
        return ask.value

    def task(self, ask: Ask) -> str:
        """What there is to do."""
        return in_language(ask.task)

    def button_text(self) -> str:
        """What the button says."""
        return tr("Done")


class ReadingPrompt(QFrame):
    """The next setting in huge digits, and a field for the reading: Enter alone says that the head stands as asked."""

    answered = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("card")
        self.setting = HugeLabel()
        self.setting.setMinimumHeight(110)
        self._prompt = PlainLabel()
        self._prompt.setWordWrap(True)
        self._prompt.setObjectName("heading")
        self.field = QLineEdit()
        self.field.setPlaceholderText(tr("12 34 56, or 12.5"))
        self.field.setAccessibleName(tr("Reading of the head"))
        self.field.returnPressed.connect(self._answer)
        self._open = False
        font = self.field.font()
        font.setPointSizeF(font.pointSizeF() * 1.6)
        self.field.setFont(font)
        line = QHBoxLayout()
        line.addWidget(self._prompt, stretch=3)
        line.addWidget(self.field, stretch=2)
        layout = QVBoxLayout(self)
        layout.addWidget(self.setting, stretch=1)
        layout.addLayout(line)

    @property
    def prompt(self) -> str:
        """What is asked."""
        return self._prompt.text()

    def ask(self, setting_deg: float, prompt: str) -> None:
        """Ask for a reading."""
        self.setting.say(local(on_the_circle(setting_deg)))
        self._prompt.setText(in_language(prompt))
        self._open = True
        self.field.setFocus(Qt.FocusReason.OtherFocusReason)

    def _answer(self) -> None:
        """One answer to each question: a second Enter says nothing."""
        if not self._open:
            return
        text = self.field.text()
        self._open = False
        self._prompt.setText(tr("Measuring…"))
        self.field.clear()
        self.answered.emit(text)
