"""What tracing found, in words."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

from tumble.calibrations.core.quantities import format_concise, format_number, format_probability
from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.core.sentences import series
from tumble.calibrations.core.view import Section
from tumble.calibrations.tracing.effect import OWNER_WORDS, Quantity
from tumble.calibrations.tracing.findings import EffectFound, Unexplained
from tumble.calibrations.tracing.variables import VARIABLE_WORDS
from tumble.messages import Message


def unexplained_sentence(unexplained: Unexplained) -> str:
    """Where structure without a name is."""
    return Message(
        "No effect of the catalogue explains what depends on {variable}: {description}.",
        variable=VARIABLE_WORDS.get(unexplained.depends_on, unexplained.depends_on),
        description=unexplained.description,
    )


def nothing_looked_for(reason: str) -> Message:
    """That no effect was looked for, and why."""
    return Message("Nothing is looked for: {reason}.", reason=reason)


_UNIT_SUFFIXES = ("_degC", "_deg", "_arcsec_h", "_arcsec", "_s", "_V", "_g", "_hz")
_COEFFICIENTS: Final[Mapping[str, Message]] = {
    "amplitude": Message("amplitude"),
    "phase": Message("phase"),
    "order": Message.named("order", "periods per turn"),
    "slope": Message("slope"),
    "step": Message("step"),
    "at": Message("at"),
    "threshold": Message("threshold"),
    "period": Message("period"),
    "row": Message("row"),
    "reach": Message("reach"),
    "kept": Message("reach, kept when it is mounted anew"),
    "natural": Message("resonance"),
}
"""What coefficients without a symbol of their own are called."""


@dataclass(frozen=True, kw_only=True)
class Finding:
    """One effect found, every cell as text."""

    name: str
    others: tuple[str, ...]
    """The effects that explain the data as well, by their names; none where it is distinguished."""
    belongs_to: str
    coefficients: str
    p_value: str

    @property
    def also_possible(self) -> str:
        """The same as a list in words; empty where there are none."""
        return series(self.others, "or") if self.others else ""


def findings(effects: Sequence[EffectFound]) -> list[Finding]:
    """The effects found, in the order of the evidence."""
    return [
        Finding(
            name=effect.name,
            others=effect.also_possible,
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
    return Message.joined(
        ", ",
        [
            Message("{name} {value}", name=_spelt(key), value=_quantity(quantity))
            for key, quantity in effect.coefficients.items()
        ],
    )


def _quantity(quantity: Quantity) -> str:
    if quantity.standard_uncertainty is not None:
        return format_concise(quantity.value, quantity.standard_uncertainty, quantity.unit)
    return f"{quantity.value:g}" if quantity.value.is_integer() else format_number(quantity.value, quantity.unit, 4)


def _spelt(key: str) -> str:
    """The name of a coefficient without the unit that its value states."""
    suffix = next((suffix for suffix in _UNIT_SUFFIXES if key.endswith(suffix)), "")
    name = key.removesuffix(suffix)
    return _COEFFICIENTS.get(name, name)


_NOT_USED = Message("Rows that were not used")
_LISTED = 6
"""Of the rows that are set aside so many are listed, the rest counted."""


def set_aside_section(name: str, aside: Sequence[SetAside]) -> Section:
    """Which rows of a table were not used, and why; empty where all were."""
    if not aside:
        return Section(title=_NOT_USED)
    listed = series([Message("{row} ({reason})", row=entry.row, reason=entry.reason) for entry in aside[:_LISTED]])
    if len(aside) > _LISTED:
        listed = Message("{rows} and {count} more", rows=listed, count=len(aside) - _LISTED)
    lines = (Message("{name}: set aside: rows {rows}", name=name, rows=listed),)
    return Section(title=_NOT_USED, lines=lines, brief=True)
