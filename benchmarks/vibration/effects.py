"""Effects as nature has them; sizes are in the units of the contract unless said."""

from collections.abc import Mapping

import numpy as np

from benchmarks.vibration.designs import Array
from benchmarks.vibration.world import Effect, Run


def _set(name: str) -> Effect:
    def effect(run: Run, size: float) -> None:
        setattr(run, name, size)

    return effect


def _resonance(run: Run, size: float) -> None:
    """The size is the square of the highest frequency over that of the resonance."""
    run.natural_hz = float(run.frequency_hz.max()) / float(np.sqrt(size))


def _clipping(run: Run, size: float) -> None:
    """The size is the part of the largest input that is cut."""
    largest = max(float(each.peak_g[0] + each.gravity_g[0]) for each in run.dwells)
    run.limit_g = largest * (1.0 - size)


def _lean(run: Run, size: float) -> None:
    run.added_ug += size * run.drive_g2 * np.array([each.drive[0] for each in run.dwells]) * run.shaken


def _pickup(run: Run, size: float) -> None:
    run.added_ug += size * run.level_g * run.shaken


def _warmth(run: Run, size: float) -> None:
    """The heat in small steps, the level ramped over two seconds."""
    tau_s = float(np.exp(run.rng.uniform(np.log(30.0), np.log(400.0))))
    run.added_ug += size * heated(run, tau_s)


def heated(run: Run, tau_s: float) -> Array:
    """Mean over each dwell of τ ẋ = drive - x."""
    step_s, now, clock_s, found = 0.5, 0.0, float(run.time_s[0] - run.long_s[0]), np.zeros(len(run.dwells))
    for number, (middle, long_s, drive) in enumerate(zip(run.time_s, run.long_s, run.drive_g2, strict=True)):
        start = middle - long_s / 2.0
        now *= np.exp(-max(start - clock_s, 0.0) / tau_s)
        steps = max(int(long_s / step_s), 1)
        total = 0.0
        for place in range(steps):
            away_s = (place + 0.5) * long_s / steps
            ramp = min(away_s, 2.0, long_s - away_s) / 2.0
            now += long_s / steps / tau_s * (drive * ramp**2 - now)
            total += now
        found[number], clock_s = total / steps, middle + long_s / 2.0
    return found


def _arm(run: Run, size: float) -> None:
    for number, each in enumerate(run.dwells):
        if each.apparatus == "double-centrifuge" and each.level_g:
            run.added_ug[number] += size * 1e-3 * (each.main_rad_s + each.sub_rad_s) ** 2 / 9.80665 * 1e6


def _shift(run: Run, size: float) -> None:
    its = np.array([each.mounting for each in run.dwells])
    left = np.array([np.count_nonzero(its[place:] == its[place]) for place in range(len(its))])
    moved = np.flatnonzero((run.level_g > 0) & (left > 5))
    row = int(run.rng.choice(moved[moved > 4]))
    run.added_ug += size * ((np.arange(len(its)) > row) & (its == its[row]))


def _drift(run: Run, size: float) -> None:
    run.added_ug += size * (run.time_s - run.time_s[0]) / 3600.0


def _temperature(run: Run, size: float) -> None:
    run.added_ug += size * (run.temperature_degc - 23.0)


def _realisations(run: Run, size: float) -> None:
    number = np.array([each.realisation for each in run.dwells])
    levels = run.rng.normal(0.0, 1.0, int(number.max()) + 1)
    run.added_ug += size * levels[number]


def _walk(run: Run, size: float) -> None:
    steps = np.sqrt(np.diff(run.time_s, prepend=run.time_s[0]) / 3600.0)
    run.added_ug += size * np.cumsum(steps * run.rng.normal(0.0, 1.0, len(steps)))


CATALOGUE: Mapping[str, tuple[Effect, float]] = {
    "k_iii": (_set("cubic"), 0.1),
    "k_iiii": (_set("quartic"), 0.01),
    "frequency_response": (_resonance, 0.01),
    "clipping": (_clipping, 0.001),
    "after_shift": (_shift, 10.0),
    "bias_drift": (_drift, 10.0),
    "bias_temperature": (_temperature, 10.0),
    "realisation_bias": (_realisations, 10.0),
    "bias_random_walk": (_walk, 20.0),
    "shaker_cross": (_set("cross"), 0.05),
    "table_lean": (_lean, 1.0),
    "drive_pickup": (_pickup, 5.0),
    "thermal_shift": (_warmth, 1.0),
    "spin": (_arm, 1e-4),
    "partial_periods": (_set("partial"), 0.05),
}
"""Each with a size from which another is scaled."""


def _threshold(run: Run, size: float) -> None:
    """Something rattles above a level."""
    run.added_ug += size * np.maximum(run.level_g - 0.6 * run.level_g.max(), 0.0)


def _saturating(run: Run, size: float) -> None:
    run.added_ug += size * np.tanh(run.level_g / (0.25 * run.level_g.max()))


def _fixture_mode(run: Run, size: float) -> None:
    """A mode of the fixture at one of the frequencies lets the unit rectify more."""
    octaves = np.log2(np.maximum(run.frequency_hz, 1e-3) / np.median(run.frequency_hz[run.frequency_hz > 0]))
    run.added_ug += (
        size * np.array([each.peak_g[0] ** 2 for each in run.dwells]) / 2.0 * np.exp(-0.5 * (octaves / 0.4) ** 2)
    )


def _high_pass(run: Run, size: float) -> None:
    frequency = run.frequency_hz
    corner = np.median(frequency[frequency > 0])
    run.added_ug += size * np.array([each.peak_g[0] ** 2 for each in run.dwells]) / (1.0 + (frequency / corner) ** 4)


def _mains(run: Run, size: float) -> None:
    run.added_ug += size * np.sin(2.0 * np.pi * 5.3 * run.time_s / np.ptp(run.time_s) + 1.0)


def _step(run: Run, size: float) -> None:
    hours = run.time_s / np.ptp(run.time_s)
    run.added_ug += size * ((hours > 0.37) & (hours < 0.71))


def _tempco(run: Run, size: float) -> None:
    """K_ii follows the temperature."""
    run.added_ug += size * run.along_input_g2 * (run.temperature_degc - 23.0)


NOVEL: Mapping[str, tuple[Effect, float, tuple[str, ...]]] = {
    "threshold": (_threshold, 5.0, ("amplitude",)),
    "saturating": (_saturating, 5.0, ("amplitude",)),
    "fixture_mode": (_fixture_mode, 1.0, ("frequency",)),
    "high_pass": (_high_pass, 1.0, ("frequency",)),
    "mains": (_mains, 5.0, ("time",)),
    "step": (_step, 5.0, ("time",)),
    "tempco": (_tempco, 1.0, ("temperature", "time")),
}
"""Each with a size, and the variables by which it may be reported."""

_FEW_LEVELS = ("centrifuge", "three-up", "mixed")
"""Three levels: any course of them is a parabola, and so K_iiii."""
NOT_SHOWN: Mapping[str, tuple[str, ...]] = {
    "threshold": _FEW_LEVELS,
    "saturating": _FEW_LEVELS,
    "step": ("fixtures", "turned", "three-up", "mixed"),  # the rest output of each mounting is its own
}
"""Programmes in which a kind without a name is the same as one that has a name."""
