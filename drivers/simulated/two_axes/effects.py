"""What a stand file may inject into the world of two axes: names, keys and units of the catalogue of the method."""

import re
from collections.abc import Iterator, Mapping
from typing import Any, Final

from pydantic import Field, model_validator

from tumble.drivers.simulated.effects import DaqNonlinearity, RangeStep
from tumble.drivers.simulated.table import Table
from tumble.messages import Message

_OF_CHANNEL: Final = re.compile(r"([xyz])\.(k_[xyz]{2,3}|scale_asymmetry)")


class Angle(Table):
    """An angle."""

    value_arcsec: float = 0.0


class Wave(Table):
    """`A sin(n φ + p)` with a known n."""

    amplitude_arcsec: float = 0.0
    phase_deg: float = 0.0


class Channels(Table):
    """One coefficient for each channel, in the unit of its effect."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0

    @property
    def values(self) -> tuple[float, float, float]:
        """In the order of the channels."""
        return (self.x, self.y, self.z)


class UnitWarmUp(Channels):
    """`amplitude exp(-t / tau_s)` of each bias, in V, from the first switch-on."""

    tau_s: float = Field(default=600.0, gt=0.0)


class LevelDrift(Table):
    """Drift of the levels of the stand."""

    x_arcsec_h: float = 0.0
    y_arcsec_h: float = 0.0


class AxisMisreading(Table):
    """Dwells, counted from 1, whose true angle is the reported one plus an error."""

    rows: tuple[int, ...]
    axis: str = "inner"
    error_arcsec: float


class TwoAxesEffects(Table):
    """Everything that may be injected; `x.k_xx` and the like in V/g² or V/g³, `x.scale_asymmetry` in V/g."""

    coefficients: Mapping[str, float] = Field(default_factory=dict)
    """Of single channels, by their names."""
    bias_temperature: Channels = Channels()
    """V/K from 23 °C."""
    scale_temperature: Channels = Channels()
    """V/g/K from 23 °C."""
    bias_drift: Channels = Channels()
    """V/h."""
    scale_drift: Channels = Channels()
    """V/g/h."""
    warm_up: UnitWarmUp = UnitWarmUp()
    realisation_bias: Channels = Channels()
    """Standard deviation of each bias from one switch-on to another, in V."""
    outer_eccentricity: Wave = Wave()
    inner_eccentricity: Wave = Wave()
    outer_second_harmonic: Wave = Wave()
    inner_second_harmonic: Wave = Wave()
    outer_backlash: Angle = Angle()
    inner_backlash: Angle = Angle()
    """Angle error after a move in - direction."""
    axes_orthogonality: Angle = Angle()
    """By how much the angle between the axes is not 90°."""
    outer_wobble: Wave = Wave()
    inner_wobble: Wave = Wave()
    level_drift: LevelDrift = LevelDrift()
    misreading: AxisMisreading | None = None
    settling: float = 0.0
    """Fraction of the previous dwell's reading that remains."""
    daq_nonlinearity: DaqNonlinearity | None = None
    range_step: RangeStep | None = None

    @model_validator(mode="before")
    @classmethod
    def _by_name(cls, table: object) -> object:
        """Gather what is of single channels, whether TOML holds `"x.k_xx"` or `x.k_xx`."""
        if not isinstance(table, Mapping):
            return table
        named = dict(_flat(table))
        known = {*cls.model_fields} - {"coefficients"}
        if unknown := sorted(name for name in named if name not in known and not _OF_CHANNEL.fullmatch(name)):
            raise ValueError(
                Message(
                    "unknown effect {unknown}; known are {known}, and x.k_xx to z.k_zzz and x.scale_asymmetry",
                    unknown=", ".join(map(repr, unknown)),
                    known=", ".join(sorted(known)),
                )
            )
        single = {name: value for name, value in named.items() if name not in known}
        return {name: value for name, value in named.items() if name in known} | {"coefficients": single}


def _flat(table: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    for name, value in table.items():
        if name in ("x", "y", "z") and isinstance(value, Mapping):
            yield from ((f"{name}.{key}", inner) for key, inner in value.items())
        elif name == "coefficients" and isinstance(value, Mapping):
            yield from value.items()
        else:
            yield name, value
