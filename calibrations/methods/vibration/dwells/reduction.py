"""Dwells reduced: the mean of each, what it was vibrated with, and the rectification against both rests."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from tumble.calibrations.methods.vibration.dwells.broadband import BroadbandFit, fit_broadband, has_line
from tumble.calibrations.methods.vibration.dwells.long_run import mean_uncertainty
from tumble.calibrations.methods.vibration.dwells.refusals import asked, constant, refused, wrong_drive
from tumble.calibrations.methods.vibration.dwells.samples import RANDOM, REST, SampledDwells, Samples
from tumble.calibrations.methods.vibration.dwells.sine import SineFit, fit_sines, fitted_at
from tumble.messages import Message

SCHEMA: Final = "tumble.dwells/1"
UG: Final = 1e6
"""µg per g."""
_CHANNELS: Final = ("reference_i_g", "reference_o_g")


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """A value with its standard uncertainty, in µg; no value where there is a reason."""

    value_ug: float | None
    standard_uncertainty_ug: float | None
    reason: str = ""

    def as_json(self) -> dict[str, Any]:
        """As `tumble.dwells/1` has it."""
        said = {"value_ug": self.value_ug, "standard_uncertainty_ug": self.standard_uncertainty_ug}
        return said | ({"reason": self.reason} if self.reason else {})


@dataclass(frozen=True, kw_only=True)
class MeanProducts:
    """Whole-period means of products of two accelerations, in g²; None where no reference says them."""

    ii_g2: float | None = None
    oo_g2: float | None = None
    io_g2: float | None = None
    ii_uncertainty_g2: float | None = None
    """Standard; of random vibration, how far the mean square of such a stretch is from that of its spectrum."""


@dataclass(frozen=True, kw_only=True)
class ReducedDwell:
    """One dwell."""

    samples: Samples
    kind: str
    mean: Estimate
    frequency_hz: float | None = None
    """None at rest, and where the drive is random."""
    amplitude_g: float | None = None
    """Of the fundamental along the input axis, peak."""
    phase_i_deg: float | None = None
    """At the start of the dwell, of A = a sin(2π f t + phase)."""
    phase_o_deg: float | None = None
    amplitude_o_g: float | None = None
    products: MeanProducts = MeanProducts()

    @property
    def vibrated(self) -> bool:
        """Whether it is no rest."""
        return self.kind != REST


@dataclass(frozen=True, kw_only=True)
class Reduction:
    """All dwells of a file."""

    dwells: tuple[ReducedDwell, ...]
    source: str = ""
    warnings: tuple[str, ...] = ()

    @property
    def rectifications(self) -> dict[int, Estimate]:
        """Of every vibrated dwell, by its number: its mean against that of both rests about it."""
        return {
            each.samples.dwell: _against_rest(self.dwells, place)
            for place, each in enumerate(self.dwells)
            if each.vibrated
        }

    @property
    def rectification(self) -> Estimate:
        """That of the only vibrated dwell."""
        found = list(self.rectifications.values())
        if len(found) == 1:
            return found[0]
        several = Message.counted(
            "{count} dwell is vibrated; it has its own",
            "{count} dwells are vibrated; each has its own",
            count=len(found),
        )
        return Estimate(value_ug=None, standard_uncertainty_ug=None, reason=several)

    def document(self) -> dict[str, Any]:
        """The result as `tumble.dwells/1`."""
        found = self.rectifications
        return {
            "schema": SCHEMA,
            "dwells": [_dwell_json(each, found.get(each.samples.dwell)) for each in self.dwells],
            "vre": self.rectification.as_json(),
            "warnings": list(self.warnings),
        }


def reduced(sampled: SampledDwells) -> Reduction:
    """Reduce the dwells of a file; what refuses to be reduced has a reason in place of its mean, and a warning."""
    noise = _rest_variances(sampled.dwells)
    dwells = tuple(_reduced(each, noise) for each in sampled.dwells)
    said = [(each, each.mean.reason or asked(each.samples)) for each in dwells]
    told = [Message("dwell {number}: {reason}", number=each.samples.dwell, reason=reason)
            for each, reason in said if reason]  # fmt: skip
    rests = sum(not each.vibrated for each in dwells)
    if rests < 2 and rests < len(dwells):
        told.append(
            Message("{source}: the rests do not show a drift; rest before and after vibration", source=sampled.source)
        )
    return Reduction(dwells=dwells, source=sampled.source, warnings=(*sampled.warnings, *told))


def _rest_variances(dwells: Sequence[Samples]) -> tuple[float, ...]:
    """Variance of each reference at rest, its own noise; 0 where nothing rests."""
    rests = [each.references_g for each in dwells if each.kind == REST]
    return tuple(float(np.mean([np.var(each) for each in channel])) for channel in zip(*rests, strict=True))


def _reduced(samples: Samples, noise: Sequence[float]) -> ReducedDwell:
    if samples.kind == REST:
        return _rest(samples)
    if reason := constant(samples.output_g, samples.references_g):
        return ReducedDwell(samples=samples, kind=samples.kind, mean=_refused(reason))
    if samples.kind == RANDOM or not (samples.drive_hz > 0.0 or has_line(samples)):
        return _random(samples, fit_broadband(samples, noise))
    return _sine(samples, noise)


def _rest(samples: Samples) -> ReducedDwell:
    if reason := constant(samples.output_g, ()):
        return ReducedDwell(samples=samples, kind=REST, mean=_refused(reason))
    mean_g = float(samples.output_g.mean())
    uncertainty_g = mean_uncertainty(samples.output_g - mean_g)
    nothing = MeanProducts(ii_g2=0.0, oo_g2=0.0, io_g2=0.0)
    return ReducedDwell(
        samples=samples, kind=REST, mean=_in_ug(mean_g, uncertainty_g), amplitude_g=0.0, products=nothing
    )


def _refused(reason: str) -> Estimate:
    return Estimate(value_ug=None, standard_uncertainty_ug=None, reason=reason)


def _in_ug(mean_g: float, uncertainty_g: float) -> Estimate:
    return Estimate(value_ug=UG * mean_g, standard_uncertainty_ug=UG * uncertainty_g)


def _random(samples: Samples, fit: BroadbandFit) -> ReducedDwell:
    return ReducedDwell(
        samples=samples,
        kind=RANDOM,
        mean=_in_ug(fit.mean_g, fit.mean_uncertainty_g),
        products=MeanProducts(
            ii_g2=fit.ii_g2, oo_g2=fit.oo_g2, io_g2=fit.io_g2, ii_uncertainty_g2=fit.ii_uncertainty_g2
        ),
    )


def _sine(samples: Samples, noise: Sequence[float]) -> ReducedDwell:
    channels, line_hz = (samples.output_g, *samples.references_g), has_line(samples)
    nominal_hz = samples.drive_hz or line_hz
    fit = fit_sines(samples.time_s, channels[:2], nominal_hz)
    away_s = samples.time_s - samples.middle_s
    fits = [*fit.channels, *(fitted_at(away_s, each, fit.frequency_hz) for each in channels[2:])]
    named = dict(zip(("output_g", *_CHANNELS), channels, strict=False))
    reason = wrong_drive(samples.time_s, fit, channels[:2], line_hz) or refused(samples.time_s, fit, named)
    output, *references = fits
    mean = _in_ug(output.offset, output.offset_uncertainty)
    shown = references[0] if references else output
    return ReducedDwell(
        samples=samples,
        kind=samples.kind,
        mean=_refused(reason) if reason else mean,
        frequency_hz=fit.frequency_hz,
        amplitude_g=shown.amplitude,
        amplitude_o_g=references[1].amplitude if len(references) > 1 else None,
        phase_i_deg=_phase_deg(samples, shown, fit.frequency_hz),
        phase_o_deg=_phase_deg(samples, references[1], fit.frequency_hz) if len(references) > 1 else None,
        products=_products(references, noise),
    )


def _phase_deg(samples: Samples, fit: SineFit, frequency_hz: float) -> float:
    """Phase of the sine at the start of the dwell, within (-180°, 180°]."""
    back_rad = 2.0 * np.pi * frequency_hz * (samples.middle_s - samples.time_s[0])
    phase_deg = np.rad2deg(np.angle(fit.phasors[0]) + np.pi / 2.0 - back_rad)
    return float(180.0 - (180.0 - phase_deg) % 360.0)


def _products(references: Sequence[SineFit], noise: Sequence[float]) -> MeanProducts:
    """Of the harmonics of the references, and of what they leave beyond their noise at rest."""
    if not references:
        return MeanProducts()
    squares = [_mean_product(each, each) + _beyond(each, own) for each, own in zip(references, noise, strict=False)]
    squares = squares or [_mean_product(each, each) for each in references]
    first = references[0]
    count = len(first.residual)
    spread = float(np.std(first.residual)) * first.amplitude / np.sqrt(count)
    several = len(references) > 1
    return MeanProducts(
        ii_g2=squares[0],
        oo_g2=squares[1] if several else None,
        io_g2=_mean_product(first, references[1]) if several else None,
        ii_uncertainty_g2=spread,
    )


def _mean_product(first: SineFit, second: SineFit) -> float:
    orders = min(len(first.phasors), len(second.phasors))
    return 0.5 * float(np.real(np.sum(first.phasors[:orders] * np.conj(second.phasors[:orders]))))


_SURE: Final = 6.0
"""Standard deviations by which what is left of a reference must exceed its noise at rest to be vibration."""


def _beyond(fit: SineFit, rest_variance: float) -> float:
    """Mean square of what is no harmonic, beyond the noise at rest; nothing where that could be it."""
    left, count = float(np.var(fit.residual)), len(fit.residual)
    return left - rest_variance if left > rest_variance * (1.0 + _SURE * np.sqrt(4.0 / count)) > 0.0 else 0.0


def _against_rest(dwells: Sequence[ReducedDwell], place: int) -> Estimate:
    """The mean of a vibrated dwell minus that of the rests before and after it, with the drift between them.

    Somewhere between the two the unit would have been at rest: the difference beyond their own uncertainty is a
    rectangular distribution (GUM 4.3.7).
    """
    mean = dwells[place].mean
    before = next((each.mean for each in reversed(dwells[:place]) if not each.vibrated), None)
    after = next((each.mean for each in dwells[place:] if not each.vibrated), None)
    rests = [each for each in (before, after) if each is not None]
    if mean.value_ug is None or mean.standard_uncertainty_ug is None:
        return mean
    if not rests:
        return Estimate(
            value_ug=None, standard_uncertainty_ug=None, reason=Message("there is no rest to compare it with")
        )
    values = np.array([each.value_ug for each in rests], dtype=float)
    variances = np.array([each.standard_uncertainty_ug for each in rests], dtype=float) ** 2
    drift = max(float(np.ptp(values) ** 2 - variances.sum()), 0.0) / 12.0 if len(rests) > 1 else 0.0
    variance = mean.standard_uncertainty_ug**2 + variances.sum() / len(rests) ** 2 + drift
    return Estimate(value_ug=mean.value_ug - float(values.mean()), standard_uncertainty_ug=float(np.sqrt(variance)))


def _dwell_json(dwell: ReducedDwell, rectification: Estimate | None) -> dict[str, Any]:
    products = dwell.products
    said = {
        "dwell": dwell.samples.dwell,
        "kind": dwell.kind,
        "mean_ug": dwell.mean.value_ug,
        "standard_uncertainty_ug": dwell.mean.standard_uncertainty_ug,
        "frequency_hz": dwell.frequency_hz,
        "amplitude_g": dwell.amplitude_g,
        "m_ii_g2": products.ii_g2,
        "m_io_g2": products.io_g2,
        "m_oo_g2": products.oo_g2,
        "m_ii_u_g2": products.ii_uncertainty_g2,
        "samples": len(dwell.samples.time_s),
    }
    reason = {"reason": dwell.mean.reason} if dwell.mean.reason else {}
    return said | reason | ({"vre": rectification.as_json()} if rectification else {})
