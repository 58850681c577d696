"""Tables of vibrated dwells for the tests: seeded, with what is in them known."""

import numpy as np

from tumble.calibrations.methods.vibration.model import COEFFICIENTS
from tumble.calibrations.methods.vibration.observations import VibrationObservations
from tumble.calibrations.methods.vibration.probes import Mounting, VibrationProbe, circle, shaken
from tumble.calibrations.methods.vibration.products import mean_products, static_products
from tumble.messages import Message

I, O, P = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)  # noqa: E741  # the axes of the standard
HALF = float(np.sqrt(0.5))
K = np.array([12.0, -5.0, 3.0, 8.0, -6.0])
"""K_ii … K_ip in µg/g²."""
FIXTURES = (
    shaken(I, O),
    shaken(I, (0.0, -1.0, 0.0), (0.0, -1.0, 0.0)),
    shaken((-1.0, 0.0, 0.0), O),
    shaken(O, I, P),
    shaken(P, I),
    shaken((HALF, HALF, 0.0), (HALF, -HALF, 0.0), P),
    shaken((HALF, 0.0, HALF), (HALF, 0.0, -HALF)),
)
CENTRIFUGE = (circle(1),)


def dwells(*mountings: Mounting, passes: int = 1) -> VibrationObservations:
    """Dwells in mountings, one after the other, without outputs; the first row is a rest of its own mounting."""
    first = VibrationObservations(
        row=np.array([1]),
        time_s=np.zeros(1),
        realisation=np.ones(1, dtype=np.int64),
        mounting=np.ones(1, dtype=np.int64),
        ai_g=np.zeros(1),
        dwell_s=np.full(1, 60.0),
        output_ug=np.zeros(1),
        output_u_ug=np.full(1, 3.0),
    )
    rows = first
    for _ in range(passes):
        rows = VibrationProbe(programme="", does=Message("none"), mountings=mountings).after(rows)
    rows = rows.over(np.arange(1, len(rows)))
    count = len(rows) // passes
    mounting = np.tile(np.asarray(rows.mounting)[:count] - 1, passes)
    return with_columns(
        rows,
        row=np.arange(1, len(rows) + 1),
        mounting=mounting,
        run=np.zeros(len(rows), dtype=np.int64),
        realisation=np.repeat(np.arange(1, passes + 1), count),
    )


def with_columns(rows, **columns):
    from dataclasses import replace

    return replace(rows, **columns)


def measured(rows: VibrationObservations, added_ug=0.0, seed: int = 1, noise_ug: float = 3.0, k=K):
    """The same with outputs: rest, rectification, what is added, noise."""
    rng = np.random.default_rng(seed)
    rests = rng.normal(0.0, 200.0, 20)
    static = np.zeros(COEFFICIENTS) if rows.gi_g is None else static_products(rows)
    output = rests[np.asarray(rows.mounting)] + (mean_products(rows) + static) @ k + added_ug
    return with_columns(rows, output_ug=output + rng.normal(0.0, noise_ug, len(rows)))
