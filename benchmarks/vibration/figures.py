"""Figures of the theory, each by the code that is used: `python -m benchmarks.vibration.figures`."""

import numpy as np

from tumble.calibrations.methods.vibration.effects.stand import arm_ug, partial_period_ug
from tumble.calibrations.methods.vibration.fit import fit_vibration
from tumble.calibrations.methods.vibration.model import NAMES, name_of
from tumble.calibrations.methods.vibration.observations import VibrationObservations
from tumble.calibrations.methods.vibration.probes import Mounting, VibrationProbe, circle, phased, shaken
from tumble.calibrations.methods.vibration.table import vibration_table
from tumble.calibrations.tracing.trace import nothing_found
from tumble.messages import Message

I, O, P = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)  # noqa: E741  # the axes of the standard
_HALF = float(np.sqrt(0.5))


def main() -> None:
    """Print them."""
    for long_s in (60.0, 1.0):
        phase = np.linspace(0.0, 2.0 * np.pi, 721)
        many = np.full(len(phase), long_s + 0.5 / 80.0)
        cut = partial_period_ug(np.full(len(phase), 10.0), phase, np.full(len(phase), 80.0), many)
        print(f"10 g, 80 Hz, {long_s:g} s and half a period: the plain mean is off by up to {cut.max():.0f} µg")
    print(f"1 s under a Hann window: up to {hann_ug(10.0, 80.5, 1.0):.1f} µg")
    for ratio, power in ((2, 2), (3, 3), (4, 4)):
        low, high, truth = _few_phases(ratio, power)
        print(f"fs/f = {ratio}: mean of the power {power} of a sine {low:.3f} to {high:.3f}, truly {truth:.3f}")
    arm = float(arm_ug(np.array([10.0]), np.array([2.0 * np.pi * 8.0]))[0])
    print(f"double centrifuge, 8 Hz, 10 rad/s: {arm / 1e4:.1f} mg for 0.1 mm; 10 µg for {1e4 / arm:.3f} µm")
    for name, mountings in EXPERIMENTS.items():
        print(f"{name}: {told(mountings)}")


def hann_ug(amplitude_g: float, frequency_hz: float, long_s: float) -> float:
    """Largest error of the mean of a sine under a Hann window, in µg."""
    time_s = (np.arange(200_000) + 0.5) / 200_000 * long_s
    window = 1.0 - np.cos(2.0 * np.pi * time_s / long_s)
    waves = [np.mean(window * wave(2.0 * np.pi * frequency_hz * time_s)) for wave in (np.sin, np.cos)]
    return 1e6 * amplitude_g * float(np.hypot(*waves))


def _few_phases(ratio: int, power: int) -> tuple[float, float, float]:
    start = np.linspace(0.0, 2.0 * np.pi, 721)[:, None]
    means = np.mean(np.sin(start + 2.0 * np.pi * np.arange(ratio) / ratio) ** power, axis=1)
    truth = float(np.mean(np.sin(2.0 * np.pi * np.arange(1000) / 1000) ** power))
    return float(means.min()), float(means.max()), truth


EXPERIMENTS = {
    "shaker along i": (shaken(I, O),),
    "shaker along i, o, p": (shaken(I, O), shaken(O, I, P), shaken(P, I)),
    "and 45° fixtures io, ip": (
        shaken(I, O),
        shaken(O, I, P),
        shaken(P, I),
        shaken((_HALF, _HALF, 0.0), (_HALF, -_HALF, 0.0), P),
        shaken((_HALF, 0.0, _HALF), (_HALF, 0.0, -_HALF)),
    ),
    "double centrifuge, OA up": (circle(1),),
    "double centrifuge, each axis up": (circle(0), circle(1), circle(2)),
    "three shakers, one frequency, phases varied": (phased(),),
    "three shakers, unequal frequencies": (phased((40.0, 70.0, 110.0)),),
}


def told(mountings: tuple[Mounting, ...]) -> str:
    """What dwells tell of the coefficients."""
    probe = VibrationProbe(programme="", does=Message("none"), mountings=mountings)
    rest = VibrationObservations(
        row=np.array([1]), time_s=np.zeros(1), ai_g=np.zeros(1), output_ug=np.zeros(1), output_u_ug=np.full(1, 3.0)
    )
    rows = probe.after(rest)
    table = vibration_table(rows, rows)
    fit = fit_vibration(table, nothing_found(table))
    alone = [name for place, name in enumerate(NAMES) if fit.told((place,))]
    return ", ".join([*alone, *(name_of(each) for each in fit.sums)]) or "nothing"


if __name__ == "__main__":
    main()
