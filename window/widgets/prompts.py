"""What the person at the stand is asked: to seat the unit, shown by a picture, or to set and read a head."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QLineEdit, QVBoxLayout, QWidget

from tumble.procedures.eyepiece import on_the_circle
from tumble.window.look.language import tr
from tumble.window.look.names import mount_name
from tumble.window.look.numbers import local
from tumble.window.look.plain import PlainLabel
from tumble.window.look.sentences import in_language
from tumble.window.widgets.huge_label import HugeLabel
from tumble.window.widgets.motion_button import MotionButton
from tumble.window.widgets.pose_picture import PosePicture


class MountPrompt(QFrame):
    """The mount by name and picture, and a button that no scanner can press: the head turns after it."""

    seated = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("card")
        self._mount = ""
        self._title = HugeLabel()
        self._title.setMaximumHeight(64)
        self._picture = PosePicture()
        self.confirm = MotionButton(tr("It sits there"), "F9")
        self.confirm.setObjectName("primary")
        self.confirm.clicked.connect(self.seated)
        hint = QLabel(tr("Seat the unit as in the picture,\nat head angle 0°."))
        layout = QVBoxLayout(self)
        layout.addWidget(self._title)
        layout.addWidget(self._picture, stretch=1)
        layout.addWidget(hint)
        layout.addWidget(self.confirm)

    @property
    def mount(self) -> str:
        """The mount that is asked for."""
        return self._mount

    def ask(self, mount: str) -> None:
        """Ask for a mount."""
        self._mount = mount
        self._title.say(mount_name(mount))
        self._picture.show_mount(mount)


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
