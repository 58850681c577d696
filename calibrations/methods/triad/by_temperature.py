"""Parameters of a triad at each temperature of a sequence: the table that the method `temperature` traces."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.methods.triad.loop import FEWEST_POSITIONS, declared_fit
from tumble.calibrations.methods.triad.model import NAMES, UNITS
from tumble.calibrations.methods.triad.observations import TriadObservations
from tumble.messages import Message

APART_K: Final = 2.0
"""Where the unit is so much warmer or colder than when a run began, another run begins."""


@dataclass(frozen=True, kw_only=True)
class AtTemperature:
    """The declared model fitted to the dwells at one temperature."""

    temperature_degc: float
    parameters: Mapping[str, Parameter]


def parameter_runs(tables: Sequence[TriadObservations]) -> dict[str, list[float]]:
    """A column for run, temperature and each parameter that all runs tell; a row for each temperature of each table.

    Raises
    ------
    ValueError
        A table without temperatures, a run of too few positions, or one that is in doubt.
    """
    fitted = [_fitted(*run) for table in tables for run in runs(table)]
    values = {name: [each.parameters[name].value for each in fitted] for name in NAMES}
    told = {name: [value for value in listed if value is not None] for name, listed in values.items()}
    return {
        "run": [float(number) for number in range(1, len(fitted) + 1)],
        "temperature_degC": [each.temperature_degc for each in fitted],
        **{
            f"{name}_{UNITS[name].replace('/', '_per_')}": listed
            for name, listed in told.items()
            if len(listed) == len(fitted)
        },
    }


def at_each_temperature(table: TriadObservations) -> tuple[AtTemperature, ...]:
    """The parameters at each temperature of a sequence, in its order; none where there is one temperature alone.

    Raises `ValueError` as `parameter_runs`.
    """
    found = list(runs(table))
    return tuple(_fitted(*run) for run in found) if len(found) > 1 else ()


def runs(table: TriadObservations) -> Iterator[tuple[float, TriadObservations]]:
    """Temperature and dwells of each run of a table. Raises `ValueError` where a temperature is missing."""
    temperature_degc = _temperature(table)
    start = 0
    for end in range(1, len(table) + 1):
        if end == len(table) or abs(temperature_degc[end] - temperature_degc[start]) > APART_K:
            chosen = (np.arange(len(table)) >= start) & (np.arange(len(table)) < end)
            yield float(temperature_degc[start:end].mean()), table.select(chosen)
            start = end


def _temperature(table: TriadObservations) -> FloatArray:
    """Of each dwell, the mean of the channels. Raises `ValueError` where there is none."""
    known = [each for each in table.temperatures_degc() if each is not None]
    if not known or not np.isfinite(known).all():
        raise ValueError(
            Message("{source}: a temperature is missing in some dwells; it takes one in each", source=table.source)
        )
    return np.asarray(np.mean(known, axis=0), dtype=float)


def _fitted(temperature_degc: float, rows: TriadObservations) -> AtTemperature:
    """The parameters of a run. Raises `ValueError`."""
    if len(np.unique(rows.positions)) < FEWEST_POSITIONS:
        raise ValueError(
            Message(
                "{source}: at some temperature there are fewer than {fewest} positions; take a list at each",
                source=rows.source,
                fewest=FEWEST_POSITIONS,
            )
        )
    declared = declared_fit(rows)
    if declared.doubts:
        raise ValueError(declared.doubts[0])
    return AtTemperature(temperature_degc=temperature_degc, parameters=declared.model.parameters)
