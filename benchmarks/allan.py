"""How often the uncertainties and intervals of an Allan deviation hold, on simulated records of known noise.

python -m benchmarks.allan --records 100
"""

import argparse

import numpy as np

from tumble.calibrations.allan.averaging import best_time
from tumble.calibrations.allan.coefficients import NAMES, Coefficient, noise_model
from tumble.calibrations.allan.deviations import deviations
from tumble.calibrations.core.arrays import FloatArray

SAMPLES = 4096
"""A second apart."""
SENSORS = ((1.0, 0.2, 0.0), (1.0, 0.1, 0.004), (1.0, 0.0, 0.01), (1.0, 0.0, 0.0))
"""N, B and K."""


def record(random: np.random.Generator, white: float, flicker: float, walk: float) -> FloatArray:
    """A record of a sensor."""
    frequency_hz = np.fft.rfftfreq(8 * SAMPLES)
    power = np.concatenate([[0.0], flicker**2 / (2.0 * np.pi * frequency_hz[1:])])
    real, imaginary = random.standard_normal((2, len(power)))
    flat = np.fft.irfft((real + 1j * imaginary) * np.sqrt(4.0 * SAMPLES * power))[:SAMPLES]
    steps = random.standard_normal((2, SAMPLES))
    return flat + white * steps[0] + np.cumsum(walk * steps[1])


def line(name: str, truth: float, found: list[Coefficient]) -> str:
    told = [each for each in found if each.value is not None]
    held = [
        each.at_most >= truth if each.value is None else abs(each.value - truth) <= 1.96 * each.standard_uncertainty
        for each in found
    ]
    return f"{name} = {truth:g}: told {len(told)} of {len(found)}, interval or limit holds {np.mean(held):.0%}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--records", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    random = np.random.default_rng(asked.seed)
    for sensor in SENSORS:
        models, minima_s, intervals_s = [], [], []
        for _ in range(asked.records):
            values = record(random, *sensor)
            models.append(noise_model(deviations(values, 1.0), SAMPLES, 1.0))
            best = best_time(values, 1.0, models[-1])
            minima_s.append(best.tau_s)
            intervals_s.append((best.low_s, best.high_s))
        print(f"N, B, K = {sensor}")
        for term, name in enumerate(NAMES):
            print("   ", line(name, sensor[term], [model.coefficients[term] for model in models]))
        low_s, high_s = np.quantile(minima_s, [0.05, 0.95])
        other_s = np.roll(minima_s, 1)
        held = np.mean([low <= each <= high for each, (low, high) in zip(other_s, intervals_s, strict=True)])
        print(f"    minimum at {low_s:.0f} to {high_s:.0f} s (5 to 95%); the next record's inside: {held:.0%}")


if __name__ == "__main__":
    main()
