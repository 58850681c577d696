"""Tables of few settings with many repeats."""

from dataclasses import replace

import numpy as np
from tables import UNIT, output

from tumble.calibrations.methods.dividing_head.observations import Observations

# GAINS-ASEN23/Flight-Software, a public repository: one accelerometer set by hand at nine positions 22.5 deg apart,
# 20 s each, cut into pieces of 5 s; output in g written as volts.
NINE_SETTINGS = {
    90.0: (-1.0924075, -1.0920933, -1.0912632, -1.0913050),
    67.5: (-1.0460405, -1.0458547, -1.0447236, -1.0447627),
    45.0: (-0.8713847, -0.8713983, -0.8721083, -0.8722103),
    22.5: (-0.4741889, -0.4744088, -0.4747193, -0.4747234),
    0.0: (-0.0081206, -0.0082559, -0.0080344, -0.0079481),
    -22.5: (0.4574291, 0.4572851, 0.4580577, 0.4579202),
    -45.0: (0.8534128, 0.8534683, 0.8543611, 0.8546172),
    -67.5: (1.0373797, 1.0371885, 1.0362260, 1.0362266),
    -90.0: (1.0829650, 1.0827234, 1.0818555, 1.0818131),
}


def table_of(settings):
    """Rows of settings one after the other, each with its repeats; `settings` as above."""
    angle_deg = np.repeat(list(settings), [len(repeats) for repeats in settings.values()])
    volts = np.concatenate([np.array(repeats) for repeats in settings.values()])
    return Observations(row=np.arange(1, len(volts) + 1), angle_deg=angle_deg, voltage_v=volts, source="sparse")


def nine_settings():
    return table_of(NINE_SETTINGS)


def with_labels(observations, numbers):
    """The same rows, each with the number of its realisation."""
    return replace(observations, realisation=np.asarray(numbers))


def pieces(angles_deg, repeats, extra_v, noise_v=1e-4, seed=1):
    """Settings that are read again and again, of a unit with something more in its output, `extra_v(angle_deg)`."""
    generator = np.random.default_rng(seed)
    angles_deg = np.asarray(angles_deg, dtype=float)
    volts = output("face-up", angles_deg, UNIT) + extra_v(angles_deg)
    settings = {
        angle: tuple(volt + noise_v * generator.normal(size=repeats))
        for angle, volt in zip(angles_deg.tolist(), volts.tolist(), strict=True)
    }
    return table_of(settings)
