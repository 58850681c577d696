"""What a stand could tell of a case at best, from the truth alone: no fit of the product and no plan of it is asked.

The first programme and every experiment that the stand can run are carried out without noise. What a rival cannot
follow of that output beside the declared model, T in variances of a dwell, is expected to put its -2 ln L above that of
the truth, in n rows, by

    D = n ln(1 + T/n) + (numbers of the rival - numbers of the truth),

where a number costs 2 and gains 1 from noise; with a standard deviation of 2 sqrt(n ln(1 + T/n)). Rivals are the
effects of the catalogue in every form; levels and a random walk are variances, the likeliest of which counts.
"""

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from benchmarks.bank.geometry import FloatArray
from benchmarks.loop.refit import Table
from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.methods.dividing_head.observations import Observations

CLOSE: Final = 3.84
"""The contract's: a rival that is behind by less is not told from what was found."""
_ONE_IN_TWENTY: Final = 1.645
VISIBLE: Final = 25.0
"""What is closer to no effect at all is seen only now and then."""
_VARIANCES: Final = 10.0 ** np.arange(-6.0, 8.1, 0.5)
"""Of a level or of a walk, in variances of a dwell."""
_MODES: Final = np.arange(40) + 0.5
_BETWEEN: Final = 4
"""So many forms are put between two of the catalogue that are scanned for."""
_REACH: Final = 1.35
"""So far beyond those that are scanned for a value may be: a longer wave is a parabola and a cubic, whatever it is."""
_FREE: Final = 1e-9
"""Columns that have less of their own are none."""


class Behind(NamedTuple):
    """How far a rival comes out behind the truth in -2 ln L."""

    least: float
    """In 95 of 100 noises it is more than this."""
    most: float
    """In 95 of 100 it is less."""


@dataclass(frozen=True, kw_only=True)
class _Rival:
    """One form of an effect."""

    name: str
    columns: FloatArray
    """Per standard deviation of a dwell."""
    numbers: int
    """Coefficients, and what was scanned for."""
    random: bool = False

    def beyond(self, rows: "_Rows") -> float:
        """How far it is behind the truth in some rows, numbers not counted."""
        columns = rows.free_of_declared(self.columns)
        products, along = columns.T @ columns, columns.T @ rows.left
        whole = float(rows.left @ rows.left)
        values, turned = np.linalg.eigh(products)
        kept = values > _FREE * max(values.max(initial=0.0), _FREE)
        values, gains = values[kept], (turned.T @ along)[kept] ** 2
        if not self.random:
            return rows.count * float(np.log1p(max(whole - np.sum(gains / values), 0.0) / rows.count))
        part = values * _VARIANCES[:, None]
        left = whole - np.sum(gains * _VARIANCES[:, None] / (1.0 + part), axis=1)
        noise = rows.count - np.sum(part / (1.0 + part), axis=1)
        return float(np.min(rows.count * np.log((left + noise) / rows.count) + np.sum(np.log1p(part), axis=1)))

    def in_rows(self, chosen: NDArray[np.int64]) -> "_Rival":
        """The same in some of the rows, each as often as it is chosen."""
        return replace(self, columns=self.columns[chosen])


class _Rows:
    """Rows without noise beside the declared model."""

    def __init__(self, declared: FloatArray, output: FloatArray) -> None:
        self._span = np.linalg.svd(declared / np.linalg.norm(declared, axis=0).clip(1e-300), full_matrices=False)
        self.left, self.count = self.free_of_declared(output), len(output)

    def free_of_declared(self, columns: FloatArray) -> FloatArray:
        """What the declared model cannot follow of columns."""
        span = self._span[0][:, self._span[1] > _FREE]
        return np.asarray(columns - span @ (span.T @ columns))


class Oracle:
    """What could be told at best.

    Parameters
    ----------
    observations
        Rows without noise, of everything that can be run.
    programmes
        The experiment of each row; empty for the rows of the first programme.
    effect
        Name of what is true.
    noise_v
        Standard deviation of a dwell, in volts.
    """

    def __init__(self, observations: Observations, programmes: NDArray[np.str_], effect: str, noise_v: float) -> None:
        table = Table(observations=observations, weights=np.ones(len(observations)))
        scene = table.scene(np.empty((len(observations), 0)))
        self._declared = table.free(scene)
        self._output = (observations.output_v - scene.output_v) / noise_v
        self._programmes = programmes
        forms = list(_rivals(scene, noise_v))
        self._numbers = min((form.numbers for form in forms if form.name == effect), default=0)
        self._forms = [form for form in forms if form.name != effect]

    @cached_property
    def first(self) -> dict[str, Behind]:
        """How far every rival is behind after the first programme."""
        return _nearest(self._expected((), self._forms))

    @property
    def visible(self) -> bool:
        """Whether the first programme shows what is true beside the declared model."""
        return self.first[""].least > VISIBLE

    @property
    def open_to_doubt(self) -> bool:
        """Whether it shows it, and may leave a rival; other cases are not worth a run."""
        return self.visible and min(self.first.values()).least < CLOSE

    def best(self, most: int) -> tuple[tuple[str, ...], dict[str, Behind]]:
        """So many runs at most, each the one after which least is missing, and what is expected after them.

        What the first programme refutes is left out: no further row speaks for it.
        """
        run: tuple[str, ...] = ()
        reached = self._expected(run, self._forms)
        others = sorted(set(self._programmes.tolist()) - {""})
        while others and len(run) < most and (still := [form for form, there in reached if there.least < CLOSE]):
            offers = {name: self._expected((*run, name), still) for name in others}
            name = max(offers, key=lambda name: _nearness(offers[name]))
            run, reached = (*run, name), offers[name]
        return run, _nearest(reached)

    def _expected(self, run: Sequence[str], forms: Sequence[_Rival]) -> list[tuple[_Rival, Behind]]:
        chosen = np.concatenate([np.flatnonzero(self._programmes == name) for name in ("", *run)])
        rows = _Rows(self._declared[chosen], self._output[chosen])
        return [(form, _behind(form.in_rows(chosen).beyond(rows), form.numbers - self._numbers)) for form in forms]


def _nearest(expected: Sequence[tuple[_Rival, Behind]]) -> dict[str, Behind]:
    """How far each effect is behind in its best form."""
    farthest_first = sorted(expected, key=lambda pair: pair[1], reverse=True)
    return {form.name: there for form, there in farthest_first}


def _behind(beyond: float, numbers: int) -> Behind:
    spread = _ONE_IN_TWENTY * 2.0 * np.sqrt(max(beyond, 0.0))
    return Behind(beyond + numbers - spread, beyond + numbers + spread)


def _nearness(expected: Sequence[tuple[_Rival, Behind]]) -> tuple[float, float]:
    """How near every rival is to being told, and how far beyond they are."""
    least = [there.least for there in _nearest(expected).values()]
    return sum(min(each, CLOSE) for each in least), sum(least)


def _rivals(scene: Scene, noise_v: float) -> Iterator[_Rival]:
    """No effect at all, every effect of the catalogue in every form, and the walk."""
    yield _Rival(name="", columns=np.empty((scene.rows, 0)), numbers=0)
    for effect in CATALOGUE:
        forms = list(effect.forms(scene))
        scanned = len(forms[0].scanned) if len(forms) > 1 else 0
        if effect.at and scanned:
            values = sorted(next(iter(form.scanned.values())) for form in forms)
            ends = [values[0] / _REACH, *values, values[-1] * _REACH]
            between = [np.geomspace(*pair, _BETWEEN + 1)[1:] for pair in itertools.pairwise(ends)]
            forms += [effect.at(scene, float(value)) for value in np.ravel(between)]
        for form in forms:
            numbers = 1 if effect.random else form.columns.shape[1] + scanned
            yield _Rival(
                name=effect.name,
                columns=form.columns / (1.0 if effect.random else noise_v),
                numbers=numbers,
                random=effect.random,
            )
    if scene.hours is not None:
        part = scene.hours / scene.hours.max()
        walk = np.sqrt(2.0) * np.sin(np.pi * np.outer(part, _MODES)) / (np.pi * _MODES)
        yield _Rival(name="bias_random_walk", columns=walk, numbers=1, random=True)
