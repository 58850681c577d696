"""The table `[exciter]` of a stand file: what shakes the unit, how far it may go, and what it is measured with."""

from typing import Final, Self

from pydantic import Field, model_validator

from tumble.drivers.errors import LimitError
from tumble.drivers.excitation import Excitation, Rotation, excitation_of, frequencies_hz, peak_g
from tumble.drivers.names import GivenName
from tumble.drivers.tables import EXCITER, TITLES, Instrument
from tumble.messages import Message

_CLOSE: Final = 1.0 + 1e-9


class ExciterTable(Instrument):
    """A shaker, several of them, or a double centrifuge."""

    level_limit_g: float = Field(gt=0.0, le=1e5)
    """Peak acceleration; there is no 'unlimited'."""
    frequency_limits_hz: tuple[float, float] = Field(alias="frequency_limits_Hz")
    ramp_s: float = Field(default=2.0, ge=0.0, le=600.0)
    """Time from rest to a level, and back."""
    arm_m: float | None = Field(default=None, gt=0.0, le=100.0)
    """Of a double centrifuge: from the axis of its arm to the unit."""
    references: dict[GivenName, float] = Field(default_factory=dict)
    """Sensitivity of the reference accelerometers, in V/g, by the channel that samples each."""
    reference_limit_g: float | None = Field(default=None, gt=0.0)
    """Where a reference says more, the excitation is ended; without it, half as much again as `level_limit_g`."""

    rest_limit_g: float | None = Field(default=None, gt=0.0)
    """Where a reference shakes by more than that (r.m.s.) at rest, something still drives; without it, half a
    hundredth of `level_limit_g`."""

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        low, high = self.frequency_limits_hz
        if not 0.0 <= low < high:
            raise ValueError(Message("frequency_limits_Hz: {low:g} is not below {high:g}", low=low, high=high))
        if any(sensitivity == 0.0 for sensitivity in self.references.values()):
            raise ValueError(Message("references: a sensitivity of 0 V/g measures nothing"))
        return self

    @property
    def most_v(self) -> dict[str, float]:
        """The greatest magnitude of a sample of each reference, in V."""
        most_g = self.reference_limit_g or 1.5 * self.level_limit_g
        return {name: most_g * abs(sensitivity) for name, sensitivity in self.references.items()}

    @property
    def quiet_v(self) -> dict[str, float]:
        """The greatest standard deviation of the samples of each reference at rest, in V."""
        quiet_g = self.rest_limit_g or 0.005 * self.level_limit_g
        return {name: quiet_g * abs(sensitivity) for name, sensitivity in self.references.items()}

    def refusal_of(self, text: str) -> str:
        """The same of the text of an excitation."""
        return self.refusal(excitation_of(text))

    def refusal(self, excitation: Excitation) -> str:
        """Why the limits forbid an excitation; empty where they do not."""
        if isinstance(excitation, Rotation) and self.arm_m is None:
            return Message("has no arm_m, and turns nothing")
        level_g = peak_g(excitation, self.arm_m or 0.0)
        low_hz, high_hz = self.frequency_limits_hz
        if isinstance(excitation, Rotation):
            low_hz = 0.0  # it begins at rest
        if level_g > self.level_limit_g * _CLOSE:
            return Message("may not do {level:.4g} g, only {limit:g} g", level=level_g, limit=self.level_limit_g)
        beyond_hz = [hz for hz in frequencies_hz(excitation) if not low_hz / _CLOSE <= hz <= high_hz * _CLOSE]
        if beyond_hz and level_g:
            return Message(
                "may not do {hz:.4g} Hz, only {low:g} to {high:g} Hz", hz=beyond_hz[0], low=low_hz, high=high_hz
            )
        return ""


def check_excitation(table: ExciterTable, excitation: Excitation) -> None:
    """Make sure that the limits allow it. Raises `LimitError`."""
    if refusal := table.refusal(excitation):
        raise LimitError(
            TITLES[EXCITER],
            refusal,
            Message("change the level or frequency, or level_limit_g and frequency_limits_Hz of the stand"),
        )
