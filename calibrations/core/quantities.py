"""Numbers as people read them: digits that the uncertainty supports, SI prefixes, signs and exponents of units.

The uncertainty has two significant digits and the value ends at the same decimal place (GUM 7.2.6). All text is in
characters that every Western code page has, so that a terminal can print it.
"""

import math
from dataclasses import dataclass
from typing import TypeGuard

from tumble.messages import Message

_PREFIXES = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k"}
_SYMBOLS = {"^2": "²", "^3": "³", "deg": "°", "√h": "h^½", "percent": "%"}
"""Of units, as names of columns and documents spell them."""
_MANY = 10_000


@dataclass(frozen=True, kw_only=True)
class Rounded:
    """A value and its uncertainty as texts that end at the same decimal place."""

    value: str
    uncertainty: str
    """Empty where there is none."""
    unit: str
    """With its SI prefix; `°` for degrees."""

    @property
    def last_place(self) -> str:
        """The uncertainty in units of the last place of the value, as the concise notation has it."""
        return self.uncertainty if "." not in self.uncertainty else self.uncertainty.replace(".", "").lstrip("0")


def rounded(value: float, uncertainty: float | None, unit: str) -> Rounded:
    """Round a value by its uncertainty and choose the prefix of its unit.

    Without an uncertainty (None, zero, not finite) the value keeps six significant digits.
    """
    exponent = _exponent(value, uncertainty, unit)
    if not _says_something(uncertainty):
        return Rounded(value=_plain(value / 10.0**exponent, 6), uncertainty="", unit=prefixed(unit, exponent))
    places = two_digit_places(uncertainty) + exponent
    return Rounded(
        value=fixed(value / 10.0**exponent, places),
        uncertainty=fixed(uncertainty / 10.0**exponent, places),
        unit=prefixed(unit, exponent),
    )


def _exponent(value: float, uncertainty: float | None, unit: str) -> int:
    """Power of ten of the prefix with which a value and its uncertainty are written."""
    if not _says_something(uncertainty):
        return prefix_exponent(abs(value), unit)
    exponent = prefix_exponent(max(abs(value), uncertainty), unit)
    if _takes_prefix(unit) and _decade(uncertainty) - exponent >= 2 and exponent + 3 in _PREFIXES:
        exponent += 3  # in the smaller unit the uncertainty would end in a zero that means nothing
    return exponent


def _says_something(uncertainty: float | None) -> TypeGuard[float]:
    return uncertainty is not None and math.isfinite(uncertainty) and uncertainty > 0


def format_quantity(value: float, uncertainty: float | None, unit: str) -> str:
    """`(1.01643 ± 0.00036) V/g`: for an expanded uncertainty (GUM 7.2.4)."""
    text = rounded(value, uncertainty, unit)
    if not text.uncertainty:
        return join(text.value, text.unit)
    return f"({text.value} ± {text.uncertainty}) {text.unit}"


def format_expanded(value: float, interval: tuple[float, float], unit: str) -> str:
    """A value with its 95% interval: `(1.01643 ± 0.00036) V/g`, or both sides where they differ in the digits shown."""
    low, high = interval
    below, above = (rounded(value, side, unit) for side in (value - low, high - value))
    if not math.isfinite(high - low) or below.uncertainty == above.uncertainty:
        return format_quantity(value, (high - low) / 2, unit)
    return _format_sides(value, value - low, high - value, unit)


def _format_sides(value: float, below: float, above: float, unit: str) -> str:
    """`2.500001 (+0.000780 / -0.000064) V`: all end at one decimal place, which the smaller side of two decides.

    No more than one place beyond that of their mean, so that a side of nearly nothing adds no digits.
    """
    mean = (below + above) / 2
    exponent = _exponent(value, mean, unit)
    finest = max(two_digit_places(side) for side in (below, above) if side > 0)
    places = exponent + min(finest, two_digit_places(mean) + 1)
    shown, minus, plus = (fixed(each / 10.0**exponent, places) for each in (value, below, above))
    return f"{shown} (+{plus} / -{minus}) {prefixed(unit, exponent)}"


def format_concise(value: float, uncertainty: float | None, unit: str) -> str:
    """`1.01643(18) V/g`: for a standard uncertainty (GUM 7.2.2)."""
    text = rounded(value, uncertainty, unit)
    return join(f"{text.value}({text.last_place})" if text.uncertainty else text.value, text.unit)


def format_in_unit(value: float, uncertainty: float | None, unit: str) -> str:
    """`0.794(15) V/g`: as `format_concise`, without a prefix, for values that stand below each other."""
    if uncertainty is None or not math.isfinite(uncertainty) or uncertainty <= 0:
        return join(_plain(value, 6), prefixed(unit))
    places = two_digit_places(uncertainty)
    text = Rounded(value=fixed(value, places), uncertainty=fixed(uncertainty, places), unit=prefixed(unit))
    return join(f"{text.value}({text.last_place})", text.unit)


def format_interval(low: float, high: float, unit: str) -> str:
    """`5 to 38 mV/g`: both ends to two digits of the half width."""
    half = (high - low) / 2
    exponent = _exponent((low + high) / 2, half, unit)
    places = two_digit_places(half) + exponent if half > 0 else 3
    ends_text = " to ".join(fixed(end / 10.0**exponent, places) for end in (low, high))
    return join(ends_text, prefixed(unit, exponent))


def format_limits(minimum: float | None, maximum: float | None, unit: str) -> str:
    """`0.95 to 1.05 V/g`, `from 2 mV`, `up to 3°`: limits as somebody wrote them, without zeros at their ends."""
    return _limits(minimum, maximum, unit, prefix_exponent(_larger(minimum, maximum), unit))


def format_limits_beside(
    value: float, uncertainty: float | None, minimum: float | None, maximum: float | None, unit: str
) -> str:
    """The same with the prefix of the value beside them, unless that makes numbers of many digits of them."""
    exponent = _exponent(value, uncertainty, unit)
    if not 1.0 <= _larger(minimum, maximum) / 10.0**exponent < _MANY:
        return format_limits(minimum, maximum, unit)
    return _limits(minimum, maximum, unit, exponent)


def _larger(minimum: float | None, maximum: float | None) -> float:
    return max(abs(end) for end in (minimum, maximum, 0.0) if end is not None)


def _limits(minimum: float | None, maximum: float | None, unit: str, exponent: int) -> str:
    low, high = ("" if end is None else f"{end / 10.0**exponent:.6g}" for end in (minimum, maximum))
    if low and high:
        return join(f"{low} to {high}", prefixed(unit, exponent))
    if low:
        return Message("from {limit}", limit=join(low, prefixed(unit, exponent)))
    return Message("up to {limit}", limit=join(high, prefixed(unit, exponent)))


def format_number(value: float, unit: str = "", digits: int = 3) -> str:
    """`102 µV`: a number without an uncertainty of its own."""
    exponent = prefix_exponent(abs(value), unit)
    return join(_plain(value / 10.0**exponent, digits), prefixed(unit, exponent))


def format_probability(p_value: float) -> str:
    """`0.41`, or `< 0.0001` for what is smaller."""
    return "< 0.0001" if p_value < 1e-4 else _plain(p_value, 2)


def format_freedom(freedom: float | None) -> str:
    """Degrees of freedom, truncated to the next lower integer (GUM G.4.1); `∞` where there is no end to them."""
    if freedom is None:
        return ""
    if not math.isfinite(freedom):
        return "∞"
    return f"> {_MANY}" if freedom > _MANY else str(math.floor(freedom + 1e-9))


def format_correlation(coefficient: float) -> str:
    """`-0.04`, `0.961`, `-0.999996`: with as many digits as it takes to see how far it is from one."""
    distance = 1 - abs(coefficient)
    if distance < 1e-9:
        return "1" if coefficient > 0 else "-1"
    return fixed(coefficient, max(3, -_decade(distance)) if distance < 0.1 else 2)


def prefix_exponent(magnitude: float, unit: str) -> int:
    """Power of ten of the SI prefix for a magnitude in `unit`; only volts and what is per volt take a prefix."""
    if not _takes_prefix(unit) or not magnitude > 0 or not math.isfinite(magnitude):
        return 0
    decade = math.floor(math.log10(magnitude) / 3 + 1e-12) * 3
    return min(max(decade, min(_PREFIXES)), max(_PREFIXES))


def prefixed(unit: str, exponent: int = 0) -> str:
    """The unit with the prefix for a power of ten, set with ² and ³, ° for deg and %; √h is written as a power."""
    for written, symbol in _SYMBOLS.items():
        unit = unit.replace(written, symbol)
    return _PREFIXES[exponent] + unit


def join(number: str, unit: str) -> str:
    """Number and unit; a degree sign stands close to its number (SI brochure, 5.4.3)."""
    return f"{number}{unit}" if unit in ("", "°", "″") else f"{number} {unit}"


def fixed(number: float, places: int) -> str:
    """A number with this many decimal places; with a negative count it is rounded to tens, hundreds and so on."""
    text = f"{round(number, places):.{max(places, 0)}f}"
    return text.removeprefix("-") if float(text) == 0 else text


def _takes_prefix(unit: str) -> bool:
    return unit.startswith("V")


def two_digit_places(uncertainty: float) -> int:
    """Decimal places at which an uncertainty has two significant digits; negative for tens and beyond."""
    return 1 - _decade(uncertainty)


def _decade(uncertainty: float) -> int:
    """Power of ten of the first of the two digits to which an uncertainty is rounded: 0.0996 is 0.10."""
    return int(f"{uncertainty:.1e}".partition("e")[2])


def _plain(number: float, digits: int) -> str:
    """Significant digits without an exponent where the number is of everyday size."""
    if number == 0:
        return "0"
    if not math.isfinite(number):
        return f"{number:g}"
    decade = int(f"{number:.{digits - 1}e}".partition("e")[2])
    if not -4 <= decade < 9:
        return f"{number:.{digits}g}"
    return fixed(number, digits - 1 - decade)
