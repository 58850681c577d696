"""Closed loops of small tables with something undeclared in them, made once for all tests."""

from dataclasses import replace
from functools import cache

import numpy as np
from tables import FLIPS, gravity_on, output, table

from tumble.calibrations.methods.dividing_head.loop.loop import Loop, close_loop
from tumble.calibrations.tracing.effect import Quantity
from tumble.calibrations.tracing.findings import EffectFound

K_XX = 2e-3
MISREAD_ROW = 21
_SWEEP_DEG = tuple(range(0, 360, 15))
PARTS = (*FLIPS, ("sweep", "face-up", _SWEEP_DEG), ("sweep", "face-down", _SWEEP_DEG))


def k_xx(mount, angle_deg):
    """k_xx of 2 mV/g²."""
    return K_XX * gravity_on(mount, angle_deg + 0.1121)[0] ** 2


def k_xx_table():
    """162 rows with k_xx of 2 mV/g²."""
    return table(*PARTS, realisations=3, extra_v=k_xx)


def misread_table():
    """The declared model, and row 21 read 10° too low."""
    rows = table(*PARTS, realisations=3)
    at = MISREAD_ROW - 1
    volts = rows.voltage_v.copy()
    volts[at] = output(rows.mount[at], [rows.angle_deg[at] + 10.0])[0]
    return replace(rows, voltage_v=volts)


@cache
def with_k_xx() -> Loop:
    return close_loop(k_xx_table())


@cache
def clean() -> Loop:
    return close_loop(table(*PARTS, realisations=3))


@cache
def misread() -> Loop:
    return close_loop(misread_table())


def found(name, also_possible=(), belongs_to="unit", p_value=1e-20, **coefficients):
    """An effect found; coefficients as (value, standard uncertainty, unit)."""
    quantities = {
        key: Quantity(value=value, standard_uncertainty=u, unit=unit) for key, (value, u, unit) in coefficients.items()
    }
    return EffectFound(
        name=name, also_possible=also_possible, belongs_to=belongs_to, coefficients=quantities, p_value=p_value
    )


def timed(loop: Loop) -> Loop:
    """The same with times, temperatures, speeds and standard deviations in its rows."""

    def with_times(calibration):
        rows = calibration.observations
        count = np.arange(len(rows), dtype=float)
        columns = {"time_s": 20.0 * count, "temperature_degc": 22.0 + 0.01 * count, "voltage_sd_v": 1e-3 + 1e-6 * count}
        columns["velocity_deg_s"] = np.where(count % 2 > 0, 10.0, -10.0)
        return replace(calibration, observations=replace(rows, **columns))

    return replace(loop, declared=with_times(loop.declared), augmented=with_times(loop.augmented))
