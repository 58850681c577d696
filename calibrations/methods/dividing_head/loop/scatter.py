"""What scatters or wanders beyond what the samples of a dwell explain: said with its size, and no effect."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Final

import numpy as np
from scipy.special import chdtri, fdtrc

from tumble.calibrations.core.quantities import format_number
from tumble.calibrations.methods.dividing_head.joint import Joint
from tumble.calibrations.tracing.fitting_noise import best_walk
from tumble.calibrations.tracing.penalties import FLICKER, NEAR
from tumble.calibrations.tracing.table import Table
from tumble.calibrations.tracing.trace import Trace
from tumble.messages import Message

CHANCE: Final = 1e-3
"""At which a table is told of scatter or wandering that is not there."""
_DRIFT: Final = "bias_drift"


def scatter_and_wandering(table: Table, trace: Trace, joint: Joint) -> Iterator[Message]:
    """A sentence on each."""
    source = joint.observations.source
    for said in (_excess(joint), _wandering(table, trace, joint)):
        if said:
            yield Message("{source}: {said}", source=source, said=said)


def _excess(joint: Joint) -> Message | None:
    """Scatter between repeats beyond that of the samples of a dwell, if they were independent."""
    rows, error = joint.observations, joint.error
    if rows.voltage_sd_v is None or rows.samples is None or not error.degrees_of_freedom:
        return None
    variance = rows.voltage_sd_v**2 / np.maximum(rows.samples, 1.0) * joint.weights
    known = np.isfinite(variance) & (rows.samples > 1)
    if not known.any():
        return None
    sampled = float(np.mean(variance[known]))
    spare = float(np.sum(rows.samples[known] - 1.0))
    if sampled <= 0.0 or fdtrc(error.degrees_of_freedom, spare, error.variance / sampled) > CHANCE:
        return None
    return Message(
        "repeats scatter by {pure}, the samples of a dwell explain {sampled}: something changes between the repeats",
        pure=format_number(error.standard_deviation, "V", 2),
        sampled=format_number(float(np.sqrt(sampled)), "V", 2),
    )


def _wandering(table: Table, trace: Trace, joint: Joint) -> Message | None:
    """Flicker beside what was found, with its floor; where a drift or a walk fits nearly as well, that too."""
    noise = trace.noise
    if not noise.flicker:
        return None
    without = table.deviance(trace.forms, replace(noise, flicker=0.0))
    if without - trace.deviance < max(chdtri(1, 2.0 * CHANCE), FLICKER):
        return None
    return Message(
        "the bias wanders ({kind}), in the Allan deviation by some {floor}",
        kind=_KINDS[_drifts(table, trace), _walks(table, trace)],
        floor=format_number(float(np.sqrt(2.0 * np.log(2.0) * noise.flicker)) * joint.noise.used_v, "V", 2),
    )


_KINDS: Final = {
    (False, False): Message("flicker"),
    (False, True): Message("walk or flicker"),
    (True, False): Message("drift or flicker"),
    (True, True): Message("drift, walk or flicker"),
}
"""By whether a drift and whether a walk explains nearly as much."""


def _walks(table: Table, trace: Trace) -> bool:
    _, deviance = best_walk(table, trace.forms, trace.noise)
    return deviance - trace.deviance < NEAR


def _drifts(table: Table, trace: Trace) -> bool:
    steady = replace(trace.noise, flicker=0.0)
    drifts = (effect for effect in table.effects if effect.name == _DRIFT and _DRIFT not in trace.names)
    forms = (form for effect in drifts for form in effect.forms(table.scene))
    return any(table.deviance([*trace.forms, form], steady) - trace.deviance < NEAR for form in forms)
