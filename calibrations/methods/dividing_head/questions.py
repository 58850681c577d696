"""Questions before answers: a table that contradicts its own description is asked about, not explained."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import compress
from tumble.calibrations.core.repeats import pure_error
from tumble.calibrations.core.sentences import series
from tumble.calibrations.methods.dividing_head.fit import fit_given_alpha0
from tumble.calibrations.methods.dividing_head.geometry import MOUNTS
from tumble.calibrations.methods.dividing_head.gross import robust_residual
from tumble.calibrations.methods.dividing_head.loop.seats import wrong_seat
from tumble.calibrations.methods.dividing_head.loop.still import PROCEDURE, in_one_pose, on_purpose
from tumble.calibrations.methods.dividing_head.model import basis, coefficients
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.poses import pose_groups
from tumble.calibrations.methods.dividing_head.realisations import with_passes
from tumble.calibrations.methods.dividing_head.screening import MOST_V
from tumble.calibrations.methods.dividing_head.unit_questions import fahrenheit, kelvin
from tumble.messages import Message, with_wording

_FEWEST_ROWS = 8
"""Fewer rows contradict nothing."""
_CLEARER = 20.0
"""Another reading of the table must leave so many times less than the description does."""
_MOSTLY = 0.6
"""A block of which more than this part is far off comes from another mount."""
_WAVES = 0.5
"""As long as waves of its own leave less than this part of what is off; else it was disturbed."""
_WAVING = 8
"""Rows of a block of which waves leave something."""
_RESOLUTION = 1e-12
_COARSE = 7.0
"""A rounding step of so many standard deviations of a dwell is twice as large in effect as the noise."""
_PAUSE_S = 30.0
_WHOLE_TURN_RAD = 7.5


@dataclass(frozen=True, kw_only=True)
class Questioned:
    """A table with what there is to ask about it."""

    observations: Observations
    """The table as it is analysed: questions among its warnings, realisations numbered where repeats are clear."""
    questions: tuple[str, ...]
    """One sentence each."""
    answerable: bool
    """False where nothing can be traced before a question is answered."""


def questioned(observations: Observations, reference_temperature_degc: float = 23.0) -> Questioned:
    """Look for contradictions between a table and its description.

    `reference_temperature_degc` is what the parameters will refer to.
    """
    if observations.voltage_v is None or len(observations) < _FEWEST_ROWS:
        return Questioned(observations=observations, questions=(), answerable=True)
    for ask in (_dead, kelvin, _unturned, _backwards, _radians, _mounts, wrong_seat, _rounded):
        if question := ask(observations):
            return Questioned(observations=_with(observations, (question,)), questions=(question,), answerable=False)
    units = fahrenheit(observations, reference_temperature_degc)
    questions = [question for question in (_sign(observations), _millivolts(observations), units) if question]
    passes = with_passes(observations)
    questions += [passes.remark] if passes.remark else []
    observations = passes.observations
    return Questioned(observations=_with(observations, tuple(questions)), questions=tuple(questions), answerable=True)


def _dead(observations: Observations) -> str:
    """Ask about an output that never changes although the unit was turned; empty where there is nothing to ask."""
    turned = np.ptp(observations.angle_deg) > 1.0
    if turned and np.ptp(observations.output_v) <= _RESOLUTION * np.abs(observations.output_v).max():
        return Message(
            "{source}: the output is {output_v:g} V in every row, however the head is turned; is the unit connected?",
            source=observations.source,
            output_v=observations.output_v[0],
        )
    return ""


def _unturned(observations: Observations) -> str:
    """Ask about a head that stands at one angle in one mount, unless the table says that this was meant."""
    if not in_one_pose(observations) or on_purpose(observations):
        return ""
    return Message(
        "{source}: angle_deg is {angle_deg:g} in every row; was the head never turned? If the unit was left still on "
        "purpose, write {procedure} into the column procedure",
        source=observations.source,
        angle_deg=observations.angle_deg[0],
        procedure=PROCEDURE,
    )


def _backwards(observations: Observations) -> str:
    """Ask about a time that runs backwards within a run: history is read from the order of the rows."""
    if observations.time_s is None:
        return ""
    back = np.flatnonzero((np.diff(observations.time_s) < 0.0) & (np.diff(observations.runs) == 0))
    if not len(back):
        return ""
    return Message(
        "{source}: time_s runs backwards at row {row}; are the rows in the order in which they were taken? Sort them",
        source=observations.source,
        row=observations.row[back[0] + 1],
    )


def _with(observations: Observations, questions: tuple[str, ...]) -> Observations:
    """The table with what there is to ask among its warnings."""
    return replace(observations, warnings=tuple(dict.fromkeys((*observations.warnings, *questions))))


def _left_v(observations: Observations) -> float:
    """Root mean square that the declared model leaves with alpha0 held at 0, in volts."""
    functions = basis(observations)
    compressed = compress(functions, observations.output_v, np.ones(len(observations)))
    theta = fit_given_alpha0(compressed, 0.0).theta
    return float(np.sqrt(np.mean((observations.output_v - functions @ coefficients(theta)) ** 2)))


def _radians(observations: Observations) -> str:
    if np.abs(observations.angle_deg).max() > _WHOLE_TURN_RAD:
        return ""
    turned = replace(observations, angle_deg=np.rad2deg(observations.angle_deg))
    if _left_v(observations) < _CLEARER / 4 * _left_v(turned) or np.ptp(observations.angle_deg) < np.pi / 2:
        return ""
    return Message(
        "{source}: angle_deg runs from {lowest:.4g} to {highest:.4g} and the output fits radians; are these radians? "
        "Write degrees",
        source=observations.source,
        lowest=observations.angle_deg.min(),
        highest=observations.angle_deg.max(),
    )


def _mounts(observations: Observations) -> str:
    """A table without mounts whose rows cannot all come from one."""
    if observations.mount is not None:
        return ""
    blocks = _blocks(observations)
    residual = robust_residual(basis(observations), observations.output_v)
    noise_v = min(_noise_v(observations, blocks), float(1.4826 * np.median(np.abs(residual))))
    rows = np.bincount(blocks)
    for inside in _each(blocks):
        residual[inside] -= np.median(residual[inside])  # a bias that jumps is no other mount
    off = np.bincount(blocks, np.abs(residual) > _CLEARER * max(noise_v, 1e-9)) / rows
    for block, inside in enumerate(_each(blocks)):
        off[block] *= _waves(observations, residual, inside)
    if not np.any((off > _MOSTLY) & (rows > 1)):
        return ""
    guessed = _guessed_mounts(observations, blocks)
    others = sorted({str(mount) for mount in guessed} - {"face-up"})
    other_seat = Message("the unit seated another way about its input axis")
    first = int(np.flatnonzero(off[blocks] > _MOSTLY)[0])
    return Message(
        "{source}: there is no column mount, but the rows cannot come from one mount: row {row} and others look like "
        "{mounts}; add the column",
        source=observations.source,
        row=observations.row[first],
        mounts=series([with_wording(mount) for mount in others]) if others else other_seat,
    )


def _each(blocks: NDArray[np.int64]) -> Iterator[NDArray[np.bool_]]:
    """The rows of every block, as a mask of all rows."""
    return (blocks == block for block in range(int(blocks.max()) + 1))


def _waves(observations: Observations, residual: FloatArray, inside: NDArray[np.bool_]) -> bool:
    """Whether two waves explain most of what the rows of a block are off, as in another mount; of few always."""
    if np.count_nonzero(inside) < _WAVING:
        return True
    return bool(np.std(_orthogonal_to_two_waves(observations, inside)) < _WAVES * np.std(residual[inside]))


def _orthogonal_to_two_waves(observations: Observations, inside: NDArray[np.bool_]) -> FloatArray:
    angle = np.deg2rad(observations.angle_deg[inside])
    waves = [wave(order * angle) for order in (1, 2) for wave in (np.sin, np.cos)]
    columns, volts = np.column_stack([np.ones_like(angle), *waves]), observations.output_v[inside]
    return np.asarray(volts - columns @ np.linalg.lstsq(columns, volts, rcond=None)[0])


def _noise_v(observations: Observations, blocks: NDArray[np.int64]) -> float:
    """Typical scatter of a block about two waves of its own: what any mount could explain."""
    left = [
        np.std(_orthogonal_to_two_waves(observations, inside))
        for inside in _each(blocks)
        if np.count_nonzero(inside) >= _WAVING
    ]
    return float(np.median(left)) if left else float("inf")


def _blocks(observations: Observations) -> NDArray[np.int64]:
    """Runs of rows between pauses or changes of procedure: a unit is seated anew only there."""
    breaks = np.diff(observations.runs, prepend=0) != 0
    if observations.time_s is not None:
        breaks |= np.diff(observations.time_s, prepend=observations.time_s[0]) > _PAUSE_S
    if observations.procedure is not None:
        breaks[1:] |= observations.procedure[1:] != observations.procedure[:-1]
    if observations.time_s is None:  # then a sweep that begins again or turns back is the only sign of a new seat
        moves_deg = np.diff(observations.angle_deg)
        breaks[1:] |= (np.abs(moves_deg) > 300.0) | (moves_deg == 0.0)
        breaks[2:] |= np.sign(moves_deg[1:]) * np.sign(moves_deg[:-1]) < 0
    return np.cumsum(breaks)


def _guessed_mounts(observations: Observations, blocks: NDArray[np.int64]) -> NDArray[np.str_]:
    """The mount in which a nominal unit comes closest to each block; the scale is that of the whole table."""
    volts = observations.output_v
    centre, scale = float(np.median(volts)), float(np.ptp(volts)) / 2
    nominal = {mount: centre + scale * _ax(mount, observations.angle_deg) for mount in MOUNTS}
    guessed = np.full(len(volts), "face-up", dtype="<U10")
    for inside in _each(blocks):
        misfit = {mount: float(np.sum((volts[inside] - nominal[mount][inside]) ** 2)) for mount in MOUNTS}
        closest = min(misfit.values())
        guessed[inside] = next(mount for mount in MOUNTS if misfit[mount] <= 1.05 * closest + 1e-12)
    return guessed


def _ax(mount: str, angle_deg: FloatArray) -> FloatArray:
    rotation = MOUNTS[mount]
    angle = np.deg2rad(angle_deg)
    return np.asarray(-rotation[0, 0] * np.sin(angle) - rotation[0, 1] * np.cos(angle))


def _sign(observations: Observations) -> str:
    functions = basis(observations)
    compressed = compress(functions, observations.output_v, np.ones(len(observations)))
    fit = fit_given_alpha0(compressed, 0.0)
    kx = float(fit.theta[1])
    if not fit.estimable[1] or kx >= 0 or abs(kx) < 10 * _left_v(observations):
        return ""
    return Message(
        "{source}: kx comes out as {kx:.4g} V/g; is the output inverted, or the sign of g? Here a projection is "
        "positive where the axis points down",
        source=observations.source,
        kx=kx,
    )


def _rounded(observations: Observations) -> str:
    """Ask about outputs whose rounding is coarser than the noise: what it does to a pose comes back at every repeat."""
    values = np.unique(observations.output_v)
    steps_v = np.diff(values)
    step_v = float(np.median(steps_v)) if len(steps_v) else 0.0
    if len(values) > len(observations) / 2 or not np.allclose(steps_v / step_v, np.round(steps_v / step_v), atol=1e-3):
        return ""
    repeats = pure_error(observations.output_v, pose_groups(observations), np.ones(len(observations)))
    if not repeats.degrees_of_freedom or repeats.standard_deviation > step_v / _COARSE:
        return ""
    return Message(
        "{source}: the output is rounded to {step_v:.4g} V, far more than repeats scatter; what is smaller is not "
        "distinguishable from the rounding, so measure with a finer resolution",
        source=observations.source,
        step_v=step_v,
    )


def _millivolts(observations: Observations) -> str:
    """Ask about outputs that no accelerometer has."""
    largest_v = float(np.abs(observations.output_v).max())
    if largest_v < MOST_V:
        return ""
    return Message(
        "{source}: outputs reach {largest_v:.4g} V; are these millivolts? Write volts",
        source=observations.source,
        largest_v=largest_v,
    )
