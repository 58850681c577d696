"""What tracing found, in words."""

from collections.abc import Sequence
from dataclasses import dataclass

from tumble.calibrations.core.quantities import format_concise, format_number, format_probability
from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.core.sentences import series
from tumble.calibrations.core.view import Section
from tumble.calibrations.tracing.effect import OWNER_WORDS, Quantity
from tumble.calibrations.tracing.findings import EffectFound, Unexplained


def unexplained_sentence(unexplained: Unexplained) -> str:
    """Where structure without a name is."""
    return f"No effect of the catalogue explains what depends on {unexplained.depends_on}: {unexplained.description}."


_UNIT_SUFFIXES = ("_deg", "_s", "_V")


@dataclass(frozen=True, kw_only=True)
class Finding:
    """One effect found, every cell as text."""

    name: str
    also_possible: str
    """The effects that explain the data as well; empty where it is distinguished."""
    belongs_to: str
    coefficients: str
    p_value: str


def findings(effects: Sequence[EffectFound]) -> list[Finding]:
    """The effects found, in the order of the evidence."""
    return [
        Finding(
            name=effect.name,
            also_possible=series(effect.also_possible, "or") if effect.also_possible else "",
            belongs_to=OWNER_WORDS[effect.belongs_to],
            coefficients=_coefficients(effect),
            p_value=format_probability(effect.p_value),
        )
        for effect in effects
    ]


def _coefficients(effect: EffectFound) -> str:
    if len(effect.coefficients) == 1:
        (quantity,) = effect.coefficients.values()
        return _quantity(quantity)
    return ", ".join(f"{_without_unit(key)} {_quantity(quantity)}" for key, quantity in effect.coefficients.items())


def _quantity(quantity: Quantity) -> str:
    if quantity.standard_uncertainty is not None:
        return format_concise(quantity.value, quantity.standard_uncertainty, quantity.unit)
    return f"{quantity.value:g}" if quantity.value.is_integer() else format_number(quantity.value, quantity.unit, 4)


def _without_unit(key: str) -> str:
    """The name of a coefficient without the unit that its value states."""
    suffix = next((suffix for suffix in _UNIT_SUFFIXES if key.endswith(suffix)), "")
    return key.removesuffix(suffix)


_LISTED = 6
"""Of the rows that are set aside so many are listed, the rest counted."""


def set_aside_section(name: str, aside: Sequence[SetAside]) -> Section:
    """Which rows of a table were not used, and why; empty where all were."""
    if not aside:
        return Section(title="Rows that were not used")
    listed = series([f"{entry.row} ({entry.reason})" for entry in aside[:_LISTED]])
    more = f" and {len(aside) - _LISTED} more" if len(aside) > _LISTED else ""
    lines = (f"{name}: set aside: rows {listed}{more}",)
    return Section(title="Rows that were not used", lines=lines, brief=True)
