"""What is chosen of the look and the language of the window: kept, and taken over at once."""

from collections.abc import Callable

from PySide6.QtCore import QObject, Signal

from tumble.messages import Language
from tumble.window import preferences
from tumble.window.look.language import tr
from tumble.window.look.shades import Shade
from tumble.window.preferences import SCALES
from tumble.window.widgets.notice import Notice


class Choices(QObject):
    """Keeps choices, wherever they were made, and says what the window has to do for them."""

    dress_wanted = Signal()
    """Colours or text size were chosen anew."""
    restart_wanted = Signal()
    """Another language was chosen."""
    notice_wanted = Signal(object)
    """`Notice`."""

    def __init__(self, busy: Callable[[], bool], parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._busy = busy

    def choose_shade(self, chosen: Shade) -> None:
        """Take other colours."""
        preferences.choose_shade(chosen)
        self.dress_wanted.emit()

    def choose_scale(self, chosen: float) -> None:
        """Take another size of text."""
        preferences.choose_text_scale(chosen)
        self.dress_wanted.emit()

    def enlarge(self, steps: int) -> None:
        """Take text that is so many steps larger, as far as there are any."""
        place = SCALES.index(preferences.text_scale()) + steps
        if place in range(len(SCALES)):  # to dress a window anew is felt
            self.choose_scale(SCALES[place])

    def choose_language(self, chosen: Language) -> None:
        """Speak another language; while the stand is at work, from the next time on."""
        preferences.choose_language(chosen)
        if not self._busy():
            self.restart_wanted.emit()
            return
        text = tr("The language changes when the window is opened the next time: the stand is at work.")
        self.notice_wanted.emit(Notice(text=text))
