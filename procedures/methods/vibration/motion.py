"""How the unit was moved in a dwell, in its axes: as the references say, or as commanded where there are none."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.vibration.dwells.sine import fit_sines, fitted_at
from tumble.drivers.excitation import Excitation, Random, Rotation, Sines, Tone, peak_g

TABLE_AXES: Final = "xyz"


@dataclass(frozen=True, kw_only=True)
class Moved:
    """Motion along the axes i, o, p of the unit: one sine each, and mean products; arrays of shape (3,) and (3, 3)."""

    peak_g: FloatArray
    frequency_hz: FloatArray
    phase_deg: FloatArray
    """A = a sin(2π f t + phase), t from the first sample."""
    products_g2: FloatArray

    def columns(self) -> dict[str, float]:
        """Those of the table of dwells."""
        named: dict[str, float] = {}
        for place, axis in enumerate("iop"):
            named[f"a{axis}_g"] = float(self.peak_g[place])
            named[f"f{axis}_hz"] = float(self.frequency_hz[place])
            named[f"phase_{axis}_deg"] = float(self.phase_deg[place])
            named[f"m{axis}{axis}_g2"] = float(self.products_g2[place, place])
        return named | {"mio_g2": float(self.products_g2[0, 1]), "mip_g2": float(self.products_g2[0, 2])}


STILL: Final = Moved(peak_g=np.zeros(3), frequency_hz=np.zeros(3), phase_deg=np.zeros(3), products_g2=np.zeros((3, 3)))


@dataclass(frozen=True, kw_only=True)
class Measured:
    """What the samples of a dwell say of the motion of the table."""

    time_s: FloatArray
    references_g: Mapping[str, FloatArray]
    """By the axis of the table, `x` to `z`."""
    rest_variances_g2: Mapping[str, float]
    """Of each at rest."""
    arm_m: float = 0.0


def moved(excitation: Excitation, measured: Measured, table: FloatArray, frequency_hz: float | None) -> Moved:
    """Motion of the unit; `table` holds the axes of the table (rows) in the unit, the frequency is that of the fit."""
    match excitation:
        case Sines(tones=tones) if len({tone.frequency_hz for tone in tones}) == 1:
            hz = frequency_hz or tones[0].frequency_hz
            return _of_phasors(_table_phasors(tones, measured, hz), hz, table)
        case Sines(tones=tones):
            return _of_several(tones, measured, table)
        case Random():
            return Moved(**{**vars(STILL), "products_g2": table.T @ _covariance(excitation, measured) @ table})
        case Rotation():
            level_g = peak_g(excitation, measured.arm_m)
            sense = np.sign(excitation.sub_rad_s)
            phasors = [np.array([level_g]), np.array([1j * sense * level_g]), np.zeros(1)]
            return _of_phasors(phasors, frequency_hz or abs(excitation.sub_rad_s) / (2.0 * np.pi), table)
        case _:
            return STILL


def _table_phasors(tones: Sequence[Tone], measured: Measured, frequency_hz: float) -> list[FloatArray]:
    """Complex amplitudes of the harmonics along x, y, z at the first sample.

    An axis without a reference moves as commanded, with the delay that one with a reference shows.
    """
    commanded = {tone.shaker or "x": _commanded(tone) for tone in tones}
    found = {axis: _phasors(axis, measured, frequency_hz) for axis in measured.references_g}
    shared = next((axis for axis in commanded if axis in found), None)
    turned = 1.0 if shared is None else np.exp(1j * np.angle(found[shared][0] / commanded[shared][0]))
    return [found.get(axis, turned * commanded.get(axis, np.zeros(1))) for axis in TABLE_AXES]


def _phasors(axis: str, measured: Measured, frequency_hz: float) -> FloatArray:
    middle_s = (measured.time_s[0] + measured.time_s[-1]) / 2.0
    fit = fitted_at(measured.time_s - middle_s, measured.references_g[axis], frequency_hz)
    orders = np.arange(1, len(fit.phasors) + 1)
    back_rad = 2.0 * np.pi * frequency_hz * orders * (middle_s - measured.time_s[0])
    return np.asarray(fit.phasors * np.exp(-1j * back_rad))


def _commanded(tone: Tone) -> FloatArray:
    return np.asarray([tone.level_g * np.exp(1j * (np.deg2rad(tone.phase_deg or 0.0) - np.pi / 2.0))])


def _of_phasors(table_phasors: Sequence[FloatArray], frequency_hz: float, table: FloatArray) -> Moved:
    """One frequency and its harmonics, turned into the axes of the unit."""
    orders = max(map(len, table_phasors))
    padded = np.array([np.pad(each.astype(complex), (0, orders - len(each))) for each in table_phasors])
    unit = table.T @ padded
    fundamental = unit[:, 0]
    peaks_g = np.abs(fundamental)
    shown = peaks_g > 1e-9 * max(float(peaks_g.max()), 1e-30)
    phase_deg = np.rad2deg(np.angle(fundamental)) + 90.0
    return Moved(
        peak_g=np.where(shown, peaks_g, 0.0),
        frequency_hz=np.where(shown, frequency_hz, 0.0),
        phase_deg=np.where(shown, 180.0 - (180.0 - phase_deg) % 360.0, 0.0),
        products_g2=0.5 * np.real(unit @ unit.conj().T),
    )


def _of_several(tones: Sequence[Tone], measured: Measured, table: FloatArray) -> Moved:
    """Shakers of different frequencies: each sine along its own axis, whose squares are told alone."""
    parts = [_of_one(tone, measured, table) for tone in tones]
    products_g2 = np.sum([part.products_g2 for part in parts], axis=0)
    peaks_g = np.array([part.peak_g for part in parts])
    if np.count_nonzero(peaks_g > 1e-6, axis=0).max() > 1:  # an axis of the unit hears several: no sine says it
        return Moved(**{**vars(STILL), "products_g2": products_g2})
    return Moved(
        peak_g=peaks_g.sum(axis=0),
        frequency_hz=np.sum([part.frequency_hz * (part.peak_g > 1e-6) for part in parts], axis=0),
        phase_deg=np.sum([part.phase_deg * (part.peak_g > 1e-6) for part in parts], axis=0),
        products_g2=products_g2,
    )


def _of_one(tone: Tone, measured: Measured, table: FloatArray) -> Moved:
    """What one shaker does along its own axis of the table."""
    hz, reference_g = tone.frequency_hz, measured.references_g.get(tone.shaker)
    if reference_g is not None:
        hz = fit_sines(measured.time_s, [reference_g], hz).frequency_hz
    own = zip(TABLE_AXES, _table_phasors((tone,), measured, hz), strict=True)
    return _of_phasors([each if axis == tone.shaker else np.zeros(1) for axis, each in own], hz, table)


def _covariance(excitation: Random, measured: Measured) -> FloatArray:
    """Covariance of the motion along x, y, z, without the noise of the references; as commanded without any."""
    covariance_g2 = np.zeros((3, 3))
    if not measured.references_g:
        covariance_g2[0, 0] = excitation.rms_g**2
        return covariance_g2
    places = [TABLE_AXES.index(axis) for axis in measured.references_g]
    found = np.atleast_2d(np.cov(np.array(list(measured.references_g.values())), bias=True))
    covariance_g2[np.ix_(places, places)] = found
    for place, axis in zip(places, measured.references_g, strict=True):
        covariance_g2[place, place] -= measured.rest_variances_g2.get(axis, 0.0)
    return covariance_g2
