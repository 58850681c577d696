"""A recording as the table that the analysis reads."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.screening import without_missing
from tumble.calibrations.methods.gyrocompass.geometry import up_rate
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations
from tumble.drivers.tables import DaqTable
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.procedures.methods.gyrocompass.layout import AZIMUTH, AZIMUTH_RATE, BASE, LEVELLING_RATE, TILT_GAMMA
from tumble.procedures.methods.gyrocompass.programme import GyrocompassProgramme
from tumble.procedures.programmes import programme_from_text
from tumble.procedures.recording.endings import warnings
from tumble.procedures.recording.recorded import Recording
from tumble.procedures.steps import Point


def demand_latitude(stand: Mapping[str, Any]) -> None:
    """Make sure that a stand file says where the stand is. Raises `ValueError`."""
    if not isinstance(stand.get("site", {}).get("latitude_deg"), int | float):
        raise ValueError(Message("gyrocompassing needs the latitude; add latitude_deg to [site]"))


def observations(recording: Recording) -> GyrocompassObservations:
    """One row per completed point, rows without a measurement set aside.

    From the mean levelling-correction rate the vertical part of the earth's rate is taken off, as far as the platform
    sees it on a base that leans: `ωζ sin γ` with the mean tilt as measured and the latitude of the stand file.
    `complete` is false, and `warnings` says why, where the file was cut off or the run ended early. Raises `InputError`
    where there is no latitude.
    """
    stand, points = recording.header.stand, recording.points
    try:
        demand_latitude(stand)
    except ValueError as error:
        raise InputError(Message("{path}: {error}", path=recording.path, error=error)) from error
    latitude_deg = float(stand["site"]["latitude_deg"])
    tilt_deg, samples = _means(points, TILT_GAMMA), [point.readings[LEVELLING_RATE].samples for point in points]
    stated_deg = np.full(len(points), latitude_deg)
    table = GyrocompassObservations(
        row=np.arange(1, len(points) + 1),
        time_s=_numbers([point.time_s for point in points]),
        realisation=np.array([point.realisation for point in points], dtype=np.int64),
        base=np.array([int(point.conditions.get(BASE, "1")) for point in points], dtype=np.int64),
        azimuth_deg=_numbers([point.positions_deg[AZIMUTH] for point in points]),
        direction=np.array([point.directions[AZIMUTH] for point in points], dtype=np.int64),
        tilt_gamma_deg=tilt_deg,
        latitude_deg=stated_deg,
        dwell_s=_numbers(samples) / rate_hz(stand),
        temperature_degc=_known([point.temperature_degc for point in points]),
        rate_deg_h=_means(points, LEVELLING_RATE) + up_rate(stated_deg) * np.sin(np.deg2rad(tilt_deg)),
        rate_sd_deg_h=_numbers([point.readings[LEVELLING_RATE].sd for point in points]),
        samples=np.array(samples, dtype=np.int64),
        azimuth_rate_deg_h=_means(points, AZIMUTH_RATE) if _all_have(points, AZIMUTH_RATE) else None,
        take=recording.takes,
        warnings=tuple(warnings(recording)),
        complete=recording.complete,
        source=str(recording.path),
    )
    return without_missing(replace(table, **_declared_noise(recording)), ("rate_deg_h",))


def rate_hz(stand: Mapping[str, Any]) -> float:
    """Rate at which the samplers of a stand file are read: that of the first."""
    samplers = [*([stand["daq"]] if "daq" in stand else []), *stand.get("samplers", {}).values()]
    told = samplers[0].get("rate_hz") if samplers else None
    return float(DaqTable.model_fields["rate_hz"].default if told is None else told)


def _numbers(values: Sequence[float]) -> FloatArray:
    return np.array(values, dtype=np.float64)


def _means(points: Sequence[Point], channel: str) -> FloatArray:
    return _numbers([point.readings[channel].mean for point in points])


def _declared_noise(recording: Recording) -> dict[str, Any]:
    """Columns of the noise that the programme declares of the gyro; none where it declares none."""
    programme = programme_from_text(recording.header.programme_text, str(recording.path))
    noise = programme.noise if isinstance(programme, GyrocompassProgramme) else None
    told = {} if noise is None else noise.model_dump(exclude_defaults=True)
    return {name: np.full(len(recording.points), size) for name, size in told.items()}


def _all_have(points: Sequence[Point], channel: str) -> bool:
    return all(channel in point.readings for point in points)


def _known(values: Sequence[float | None]) -> FloatArray | None:
    """NaN where a single one is missing; None where all are."""
    return None if all(value is None for value in values) else np.array(values, dtype=np.float64)
