"""Names that a person gives for a recording to hold: of a unit, of its lot, of whoever is at the stand."""

from unicodedata import normalize

from tumble.drivers.text import LONGEST_NAME, check_name
from tumble.messages import Message
from tumble.procedures.errors import InputError


def given_name(text: str, field: str) -> str:
    """A name without the blanks round it; `field` is where it was given. Raises `InputError` where it can be none.

    Of the spellings of a letter with an accent, which look alike, it has the composed one (Unicode Standard Annex 15).
    """
    try:
        return check_name(normalize("NFC", text.strip()))
    except ValueError as error:
        raise InputError(Message("{option}: {error}", option=field, error=error)) from error


def given_serial_number(text: str, field: str) -> str:
    """Likewise; a unit has one."""
    if name := given_name(text, field):
        return name
    raise InputError(
        Message("{option}: give the unit's serial number, 1 to {most} characters", option=field, most=LONGEST_NAME)
    )
