"""Which positions would tell apart what a table of a triad cannot."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.joining import appended
from tumble.calibrations.core.sentences import deviations, series
from tumble.calibrations.methods.triad.fit import TriadFit, fit_triad
from tumble.calibrations.methods.triad.observations import TriadObservations
from tumble.calibrations.methods.triad.programmes import POSITIONS, Position
from tumble.calibrations.methods.triad.scene import TriadScene
from tumble.calibrations.methods.triad.table import TriadTable
from tumble.calibrations.tracing.explained import Explained
from tumble.calibrations.tracing.quantified import form_in
from tumble.calibrations.tracing.rivals import Rival
from tumble.calibrations.tracing.trace import Trace
from tumble.messages import Message

APART = 16.0
"""Explanations that differ by this in -2 ln L are distinguished: four standard deviations."""
_DWELL_S = 175.0
"""Time from dwell to dwell where the table has none."""
OFFERED = ("8o", "12", "12o", "16o", "18", "fine", "24")
"""The shortest first."""


@dataclass(frozen=True, kw_only=True)
class Experiment:
    """What to measure next, and why."""

    separates: tuple[str, ...]
    programme: str
    """Name of a list of positions; empty where none would help."""
    why: str
    separation: float = 0.0

    @property
    def command(self) -> str:
        """What to type at a stand; empty where no list would help."""
        return f"tumble run --programme {self.programme} --serial SERIAL" if self.programme else ""


def next_experiments(explained: Explained[TriadTable, TriadFit]) -> tuple[Experiment, ...]:
    """For every effect that has rivals, the shortest list of positions that tells it from each; else what is missing.

    What the positions do not tell of the parameters at all is asked for first.
    """
    return (*_unseen(explained), *(each for name, rivals in explained.close.items() if rivals
                                   for each in [_told(explained, name, rivals)]))  # fmt: skip


def _unseen(explained: Explained[TriadTable, TriadFit]) -> Iterator[Experiment]:
    names = [name for name, each in explained.best.parameters().items() if each.value is None]
    if names:
        yield Experiment(
            separates=tuple(names),
            programme="24",
            why=Message(
                "these positions do not identify {names}; the 24 positions of programme 24 do", names=series(names)
            ),
        )


def _told(explained: Explained[TriadTable, TriadFit], name: str, rivals: Sequence[Rival]) -> Experiment:
    """The shortest list that tells an effect from its rivals."""
    others = tuple(rival.name for rival in rivals)
    offers = [(programme, _separation(explained, rivals, POSITIONS[programme])) for programme in OFFERED]
    programme, apart = next((each for each in offers if each[1] >= APART), max(offers, key=lambda each: each[1]))
    if apart < APART:
        return Experiment(
            separates=(name, *others),
            programme="",
            why=Message(
                "no list of positions that comes along tells {name} from {others}: they differ by {deviations} at most",
                name=name,
                others=series(others, "or"),
                deviations=deviations(apart),
            ),
            separation=apart,
        )
    return Experiment(
        separates=(name, *others),
        programme=programme,
        why=Message(
            "positions {programme} once more: {name} then differs from {others} by {deviations}",
            programme=programme,
            name=name,
            others=series(others),
            deviations=deviations(apart),
        ),
        separation=apart,
    )


def _separation(
    explained: Explained[TriadTable, TriadFit], rivals: Sequence[Rival], positions: Sequence[Position]
) -> float:
    """Expected difference in -2 ln L of the closest rival, if what was found is true, after these positions."""
    table = explained.table
    scene = replace(table.scene, observations=planned(table.observations, positions))
    root = np.sqrt(np.repeat(table.weights[:: table.scene.dwells][:3], scene.dwells))
    true = sum(
        (form_in(scene, item).columns @ explained.best.coefficients[columns]
         for item, columns in zip(explained.best.found, explained.best.columns, strict=True)),
        np.zeros(scene.rows),
    )  # fmt: skip
    lefts = [_left(table, scene, rival.trace, true, root) / explained.best.dwell for rival in rivals]
    return float(min(scene.rows * np.log1p(np.sum(left**2) / scene.rows) for left in lefts))


def _left(table: TriadTable, scene: TriadScene, trace: Trace, true: FloatArray, root: FloatArray) -> FloatArray:
    """What the declared model and the effects of a trace cannot follow of a signal, weighted, shape (rows,)."""
    theta = fit_triad(table, trace).theta
    slopes = table.functions(scene) @ table.model.slopes(theta)
    columns = np.column_stack([slopes, *(form_in(scene, item).columns for item in trace.found)]) * root[:, None]
    length = np.linalg.norm(columns, axis=0)
    solution = np.linalg.lstsq(columns / np.where(length > 0, length, 1.0), true * root, rcond=1e-9)[0]
    return np.asarray(true * root - columns / np.where(length > 0, length, 1.0) @ solution)


def planned(before: TriadObservations, positions: Sequence[Position]) -> TriadObservations:
    """A table with the dwells that a list of positions would add; what it says nothing of stays as it was last."""
    outer_deg, inner_deg = np.array(positions).T
    count = len(positions)
    columns: dict[str, Any] = {
        "row": before.row.max() + np.arange(1, count + 1),
        "outer_deg": outer_deg,
        "inner_deg": inner_deg,
    }
    for name, angle_deg, said in (
        ("outer_direction", outer_deg, before.outer_direction),
        ("inner_direction", inner_deg, before.inner_direction),
    ):
        if said is not None:
            columns[name] = np.sign(np.diff(angle_deg, prepend=angle_deg[0] - 1.0)).astype(np.int64)
    if before.time_s is not None:
        step_s = float(np.median(np.diff(before.time_s))) if len(before) > 1 else _DWELL_S
        columns["time_s"] = before.time_s[-1] + step_s * np.arange(1, count + 1)
    return appended(before, replace(before.lasting(count), **columns))
