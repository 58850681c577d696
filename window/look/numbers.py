"""Numbers and units as the language of the window writes them."""

from tumble.numerals import localised
from tumble.window.look.language import spoken


def local(text: str) -> str:
    """Text with numbers and units in it, with the decimal sign and the units of the language."""
    return localised(text, spoken())


def parse_number(text: str) -> float:
    """A number that somebody typed, with comma or point. Raises `ValueError`."""
    return float(text.strip().replace(",", ".").replace("−", "-"))


def minutes(duration_s: float) -> str:
    """`1:05:09`: a duration in hours, minutes and seconds."""
    whole_minutes, seconds = divmod(max(round(duration_s), 0), 60)
    hours, rest = divmod(whole_minutes, 60)
    return f"{hours}:{rest:02d}:{seconds:02d}" if hours else f"{rest}:{seconds:02d}"
