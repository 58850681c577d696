"""What a person chose for the window; what was never chosen, or cannot be read any more, is as usual."""

from typing import Final, TypeVar

from PySide6.QtCore import QSettings

from tumble.messages import Language
from tumble.window.kept import kept_number, kept_text
from tumble.window.look.language import preferred
from tumble.window.look.shades import Shade

SCALES: Final = (0.8, 1.0, 1.25, 1.5, 1.75, 2.0, 2.5)
"""Sizes of text that can be chosen; 1 is usual."""
_Choice = TypeVar("_Choice", Shade, Language)


def shade() -> Shade:
    """The colours that were chosen."""
    return _choice("look/shade", Shade.DESKTOP)


def choose_shade(chosen: Shade) -> None:
    """Keep colours."""
    QSettings().setValue("look/shade", str(chosen))


def language() -> Language:
    """The language that was chosen, or that of the desktop."""
    return _choice("look/language", preferred())


def choose_language(chosen: Language) -> None:
    """Keep a language."""
    QSettings().setValue("look/language", str(chosen))


def text_scale() -> float:
    """The size of text that was chosen: the one of `SCALES` that is nearest to what is kept."""
    kept = kept_number("look/text_scale", 1.0)
    return min(SCALES, key=lambda scale: abs(scale - kept))


def choose_text_scale(chosen: float) -> None:
    """Keep a size of text."""
    QSettings().setValue("look/text_scale", chosen)


def calls_by_sound() -> bool:
    """Whether a person who is waited for is called by a sound."""
    return _is_on("call/sound")


def calls_by_flash() -> bool:
    """Whether the window then asks the desktop for attention."""
    return _is_on("call/flash")


def choose_sound(chosen: bool) -> None:
    """Have a sound or none."""
    QSettings().setValue("call/sound", "on" if chosen else "off")


def choose_flash(chosen: bool) -> None:
    """Have the window ask for attention, or not."""
    QSettings().setValue("call/flash", "on" if chosen else "off")


def _is_on(name: str) -> bool:
    return kept_text(name, "on") != "off"


def _choice(name: str, usual: _Choice) -> _Choice:
    try:
        return type(usual)(kept_text(name, usual))
    except ValueError:
        return usual
