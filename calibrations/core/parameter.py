"""A parameter with its uncertainty, as a result states it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from tumble.messages import Message, with_wording


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """One parameter of the unit with its uncertainty, or why there is none."""

    name: str
    unit: str
    value: float | None
    """None where it is not identifiable."""
    standard_uncertainty: float | None = None
    """Combined (GUM 5.1.2): type A from the data, type B from the stand."""
    type_a: float | None = None
    degrees_of_freedom: float | None = None
    """Effective, by Welch-Satterthwaite; infinite where all is type B."""
    interval_95: tuple[float, float] | None = None
    """Expanded uncertainty as an interval; not symmetric for a blunt alpha0."""
    reason: str = ""
    """Why there is no value; empty where there is one."""
    given: Mapping[str, float] = field(default_factory=dict)
    """The value of a parameter that is not identifiable, by its name, for which this value stands; empty for none.

    Or, with 0, an effect that the rows could hide. Of a parameter without a value: what it is by each of several
    effects that are not told apart.
    """
    rests_on: str = ""
    """A parameter without which this one would not be identifiable, or an effect on whose absence it rests."""
    remark: str = ""
    settled_by: tuple[str, ...] = ()
    """Mounts that would settle it, each alone."""

    @property
    def significant(self) -> bool:
        """Whether zero lies outside the 95% interval."""
        return self.interval_95 is not None and not self.interval_95[0] <= 0.0 <= self.interval_95[1]

    @property
    def rests_on_absence(self) -> bool:
        """Whether it stands only if there is no effect of a kind that the rows could hide."""
        return bool(self.rests_on) and self.rests_on in self.given

    @property
    def condition(self) -> str:
        """On what the value stands though that was not measured; empty where it stands by itself."""
        if self.rests_on_absence:
            return Message("if there is no {effect}", effect=with_wording(self.rests_on))
        if len(self.given) > 1:
            return ""  # it has no value, and the reason says it
        if self.given:
            ((name, value),) = self.given.items()
            return Message("given {name} = {value_deg:g}°", name=name, value_deg=value)
        return Message("rests on {name} alone", name=self.rests_on) if self.rests_on else ""

    def withheld(self, reason: str) -> "Parameter":
        """The parameter without a value, for a reason."""
        return Parameter(name=self.name, unit=self.unit, value=None, reason=reason)

    def as_json(self) -> dict[str, Any]:
        """The parameter as the result format has it; keys without content are left out."""
        optional = {
            "type_a": self.type_a,
            "degrees_of_freedom": finite(self.degrees_of_freedom),
            "interval_95": list(self.interval_95) if self.interval_95 else None,
            "reason": self.reason,
            "given": dict(self.given),
            "rests_on": self.rests_on,
            "remark": self.remark,
            "settled_by": list(self.settled_by),
        }
        required = {"value": self.value, "standard_uncertainty": self.standard_uncertainty, "unit": self.unit}
        return required | {key: content for key, content in optional.items() if content not in (None, "", [], {})}


def finite(value: float | None) -> float | None:
    """The value, or None where it is infinite, which JSON has no word for."""
    return value if value is not None and value < 1e9 else None


@dataclass(frozen=True, kw_only=True)
class ModelFit:
    """One of the two models of a table: declared, or with what was found."""

    parameters: Mapping[str, Parameter]
    residual_rms: float | None
    """None where nothing is stated."""
    held_out_rms: float | None
    """On rows that neither chose an effect nor fitted its coefficients; None where too few remain."""
