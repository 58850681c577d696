"""The method `temperature`: parameters of a sensor against temperature."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.sentences import series
from tumble.calibrations.core.view import Quantity, Section
from tumble.calibrations.methods.temperature.columns import Column, named, says_runs
from tumble.calibrations.methods.temperature.document import document
from tumble.calibrations.methods.temperature.entry import VERSION, entry
from tumble.calibrations.methods.temperature.later import LaterValue, later_json, later_section, later_values
from tumble.calibrations.methods.temperature.loop import ParameterLoop, TemperatureLoop, close_temperature_loop
from tumble.calibrations.methods.temperature.sections import sections
from tumble.calibrations.methods.temperature.table import read_later, read_runs
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.tracing.sentences import set_aside_section
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class TemperatureResult:
    """One table of runs."""

    name: str
    loop: TemperatureLoop
    later: tuple[LaterValue, ...] = ()
    """Later runs held against it."""

    @property
    def warnings(self) -> tuple[str, ...]:
        """None: what these runs cannot tell stands among the results."""
        return ()

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """The constant of every parameter, with what was found."""
        return {each.name: each.augmented.parameters["constant"] for each in self.loop.parameters}

    @property
    def quantities(self) -> Mapping[str, Quantity]:
        """What the constants are called: of a parameter that follows temperature it is no value that it ever has."""
        return {
            each.name: Quantity(symbol=each.name.removesuffix(f"_{each.unit}"), words=_words(each))
            for each in self.loop.parameters
        }

    def document(self) -> dict[str, Any]:
        """The result as `tumble.loop/1`."""
        return document(self.loop) | ({"later": later_json(self.later)} if self.later else {})

    def entry(self) -> Entry:
        """The result as the store takes it."""
        found = entry(self.loop)
        return replace(found, result=self.document()) if self.later else found

    def sections(self) -> Sequence[Section]:
        """What is shown."""
        held = [later_section(self.later)] if self.later else []
        return [set_aside_section(self.name, self.loop.runs.set_aside), *held, *sections(self.loop)]


def _words(parameter: ParameterLoop) -> Message:
    return Message("constant term; it follows temperature") if parameter.effects else Message("constant")


@dataclass(frozen=True)
class Temperature:
    """Parameters of a sensor against temperature."""

    name: str = "temperature"
    version: int = VERSION
    title: str = Message("Parameters against temperature")
    columns: str = Message("parameters against temperature (…_degC, and each parameter with its unit, as bias_mV)")
    headline: str = ""

    def reads(self, header: Sequence[str], numbers: Sequence[str] | None) -> bool:
        """Whether a table holds parameters and a temperature, and no angle of a head."""
        return numbers is not None and "angle_deg" not in header and says_runs(numbers)

    def hint(self, header: Sequence[str], numbers: Sequence[str]) -> str:  # noqa: ARG002  # numbers alone matter
        """Which columns say no parameter with its unit, or that a temperature is missing."""
        unsaid, temperatures = named(numbers, Column.UNKNOWN), named(numbers, Column.TEMPERATURE)
        if temperatures and unsaid:
            return Message.counted(
                "not a table that tumble knows: column {names} says no parameter of a sensor with its unit",
                "not a table that tumble knows: columns {names} say no parameter of a sensor with its unit",
                count=len(unsaid),
                names=series(unsaid),
            )
        if named(numbers, Column.PARAMETER) and not temperatures:
            return Message("column angle_deg, or a temperature in °C (…_degC) is missing")
        return ""

    def close_loop(self, paths: Sequence[Path]) -> TemperatureResult:
        """Trace a table of runs, and hold the runs of later tables against it. Raises `TableError`, `ValueError`."""
        first, *others = paths
        loop = close_temperature_loop(read_runs(first))
        later = later_values(loop, [read_later(path) for path in others])
        if others and not later:
            raise ValueError(
                Message("{path}: has no parameter of {first}; name its columns alike", path=others[0], first=first)
            )
        return TemperatureResult(name=first.name, loop=loop, later=later)


METHOD = Temperature()
