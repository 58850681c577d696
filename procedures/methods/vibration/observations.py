"""A recording as the table that the analysis reads: every dwell reduced from its samples."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.core.screening import without_missing
from tumble.calibrations.methods.vibration.dwells.reduction import ReducedDwell, reduced
from tumble.calibrations.methods.vibration.dwells.samples import SampledDwells
from tumble.calibrations.methods.vibration.observations import (
    DOUBLE_CENTRIFUGE,
    MULTI_SHAKER,
    SHAKER,
    VibrationObservations,
)
from tumble.drivers.excitation import Excitation, Random, Rest, Rotation, Sines, peak_g
from tumble.drivers.tables import EXCITER
from tumble.messages import Message
from tumble.procedures.methods.vibration.motion import Measured, moved
from tumble.procedures.methods.vibration.programme import VibrationProgramme
from tumble.procedures.methods.vibration.sampled import SampledDwell, sampled_dwells
from tumble.procedures.recording.endings import warnings
from tumble.procedures.recording.recorded import Recording


def observations(recording: Recording) -> VibrationObservations:
    """One row per completed point; a dwell that cannot be reduced is set aside with the reason.

    `complete` is false, and `warnings` says why, where the file was cut off or the run ended early.
    """
    programme = VibrationProgramme.from_text(recording.header.programme_text, str(recording.path))
    dwells = sampled_dwells(recording, programme.scale_v_per_g)
    reduction = reduced(SampledDwells(dwells=tuple(each.samples for each in dwells), source=str(recording.path)))
    arm_m = float(_exciter(recording).get("arm_m", 0.0))
    rest_g2 = _rest_variances(dwells)
    apparatus, mountings = _apparatus(dwells), _mountings(dwells)
    rows = [
        _row(dwell, found, Measured(
            time_s=dwell.time_s, references_g=dwell.references_g, rest_variances_g2=rest_g2, arm_m=arm_m,
        ))
        for dwell, found in zip(dwells, reduction.dwells, strict=True)
    ]  # fmt: skip
    numbers: dict[str, Any] = {
        name: np.array([row[name] for row in rows], dtype=np.float64) for name in (rows[0] if rows else _NAMES)
    }
    takes = np.array([dwell.point.take for dwell in dwells], dtype=np.int64)
    temperatures = [dwell.point.temperature_degc for dwell in dwells]
    table = VibrationObservations(
        row=np.array([dwell.point.index + 1 for dwell in dwells], dtype=np.int64),
        realisation=np.array([dwell.point.realisation for dwell in dwells], dtype=np.int64),
        take=takes if (takes > 1).any() else None,
        apparatus=np.array(apparatus),
        mounting=np.array(mountings, dtype=np.int64),
        temperature_degc=None if None in temperatures else np.array(temperatures, dtype=np.float64),
        warnings=(*warnings(recording), *_levels_missed(dwells, rows)),
        complete=recording.complete,
        source=str(recording.path),
        **numbers,
    )
    return without_missing(table.without(_refused(dwells, reduction.dwells)), ("output_ug",))


_NAMES = ("time_s", "output_ug")
_MISSED = 0.1
"""Part of its level by which a shaker may miss it before that is told."""


def _row(dwell: SampledDwell, found: ReducedDwell, measured: Measured) -> dict[str, float]:
    """The numbers of a row, by column."""
    excitation, mounting = dwell.excitation, dwell.mounting
    motion = moved(excitation, measured, mounting.table, found.frequency_hz)
    of_one_shaker = isinstance(excitation, Random) or (
        isinstance(excitation, Sines) and not any(tone.shaker for tone in excitation.tones)
    )
    along = mounting.table if of_one_shaker or isinstance(excitation, Rest) else np.zeros((3, 3))
    rates = (excitation.main_rad_s, excitation.sub_rad_s) if isinstance(excitation, Rotation) else (0.0, 0.0)
    return {
        "time_s": dwell.point.time_s,
        **_vector("drive_{}", along[0]),
        **_vector("lateral_{}", along[1]),
        **_vector("g{}_g", mounting.gravity_g),
        "level_g": excitation.rms_g if isinstance(excitation, Random) else peak_g(excitation, measured.arm_m),
        **motion.columns(),
        "main_rad_s": rates[0],
        "sub_rad_s": rates[1],
        "dwell_s": dwell.duration_s,
        "output_ug": np.nan if found.mean.value_ug is None else found.mean.value_ug,
        "output_u_ug": found.mean.standard_uncertainty_ug or np.nan,
    }


def _vector(name: str, values: FloatArray) -> dict[str, float]:
    return {name.format(axis): float(value) for axis, value in zip("iop", values, strict=True)}


def _refused(dwells: Sequence[SampledDwell], found: Sequence[ReducedDwell]) -> tuple[SetAside, ...]:
    """What no mean can be taken of."""
    beyond = Message("clipping: samples are beyond the range of the sampler; take a lower level, or a larger range")
    reasons = {
        dwell.point.index + 1: beyond if dwell.overloaded else each.mean.reason
        for dwell, each in zip(dwells, found, strict=True)
    }
    return tuple(SetAside(row=row, reason=reason) for row, reason in reasons.items() if reason)


def _levels_missed(dwells: Sequence[SampledDwell], rows: Sequence[Mapping[str, float]]) -> Iterator[str]:
    """A sentence where the references say another level than was commanded; what they say is used."""
    for dwell, row in zip(dwells, rows, strict=True):
        found_g = float(np.sqrt(2.0 * (row["mii_g2"] + row["moo_g2"] + row["mpp_g2"])))
        alone = isinstance(dwell.excitation, Sines) and len(dwell.excitation.tones) == 1
        if alone and dwell.references_g and abs(found_g - row["level_g"]) > _MISSED * row["level_g"]:
            yield Message(
                "point {index}: {level:.4g} g were commanded, and the reference says {found:.4g} g, which is used; "
                "look at the amplifier, and at the sensitivity in the stand file",
                index=dwell.point.index,
                level=row["level_g"],
                found=found_g,
            )


def _rest_variances(dwells: Sequence[SampledDwell]) -> dict[str, float]:
    """Variance of each reference at rest, its own noise."""
    rests = [dwell.references_g for dwell in dwells if isinstance(dwell.excitation, Rest)]
    axes = rests[0] if rests else {}
    return {axis: float(np.mean([np.var(each[axis]) for each in rests if axis in each])) for axis in axes}


def _apparatus(dwells: Sequence[SampledDwell]) -> list[str]:
    """What shakes in every dwell; a rest belongs to what comes next, the last one to what came."""
    found = [_apparatus_of(dwell.excitation) for dwell in dwells]
    known = next((each for each in reversed(found) if each), SHAKER)
    for place in reversed(range(len(found))):
        known = found[place] or known
        found[place] = known
    return found


def _apparatus_of(excitation: Excitation) -> str:
    match excitation:
        case Rest():
            return ""
        case Rotation():
            return DOUBLE_CENTRIFUGE
        case Sines(tones=tones) if any(tone.shaker for tone in tones):
            return MULTI_SHAKER
        case _:
            return SHAKER


def _mountings(dwells: Sequence[SampledDwell]) -> list[int]:
    """Number of the mounting of each dwell: another one whenever the unit was mounted otherwise."""
    numbers: list[int] = []
    for place, dwell in enumerate(dwells):
        same = place > 0 and dwell.mounting == dwells[place - 1].mounting
        numbers.append(numbers[-1] + (not same) if numbers else 1)
    return numbers


def _exciter(recording: Recording) -> Mapping[str, Any]:
    found = recording.header.stand.get(EXCITER, {})
    return found if isinstance(found, Mapping) else {}
