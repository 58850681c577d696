"""On what an effect rests: how many blocks of the variable on which it depends, and whether it holds in them.

Repeats carry no evidence of a shape: rows that share a value of the variable (a setting, a stretch of time, a visit of
a temperature) are one block. Three things are asked of every effect, beside everything else that was found:

- *Among blocks* it explains more than what blocks differ by without a shape: the F test of its mean square against that
  of the lack of fit of the blocks, with the freedom of the blocks, not of the rows (Draper and Smith, 2.1). What is
  allowed to differ is a level of each block where the effect is one number in each, else its size in each.
- *Held out*: rows of a whole block are predicted better from all other blocks with the effect than without it.
- *Seen*: what is stated of it is not many times what is seen beside the model. A shape is known to a per cent at best;
  if x is what is stated and s what of it no other column can follow, an error ε |x| of the shape changes its size by up
  to ε |x|/|s|. With ε = 1 % and |x| = 30 |s| that is 30 %: beyond it no more than an order of magnitude is left.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.special import fdtrc

from calibrations.effects.effect import Structure, Variable
from calibrations.geometry import FloatArray
from calibrations.tracing.quantified import tangent
from calibrations.tracing.table import Table
from calibrations.tracing.trace import Found, Trace

MOST_INFLATED: Final = 30.0
"""So many times larger than what is seen of it an effect may be; see above."""
HELD_OUT_MARGIN: Final = 4.0
"""The sum of squares of held-out errors must fall by so many mean squares of the lack of fit: by two deviations."""
_STRETCHES: Final = 24
"""Into so many stretches of time a table is cut; where most of the effect is, it is cut finer."""
_WITHIN: Final = 0.1
"""What varies by less than this part within settings is a function of the setting."""
_SEEN: Final = 1e-5
"""Columns of which less than this part is left beside others are not seen."""
_RIDGE: Final = 1e-9
IntArray = NDArray[np.int64]
UNITS_OF: Final[Mapping[Variable, str]] = {
    "angle": "settings",
    "acceleration": "settings",
    "direction": "settings",
    "time": "stretches of time",
    "order": "dwells",
    "temperature": "visits of a temperature",
    "realisation": "realisations",
}
"""What blocks of a variable are called."""


@dataclass(frozen=True, kw_only=True)
class Evidence:
    """What speaks for one effect of a trace."""

    name: str
    unnamed: bool
    variable: Variable
    """The variable whose blocks count."""
    blocks: int
    """Distinct settings, stretches, visits."""
    freedom: int
    """Blocks that are left beside everything that is fitted; nothing can be tested with none."""
    p_value: float
    """Chance of so much among the blocks; 1 where nothing can be tested."""
    chance: float
    """At which the effect is believed: all effects, and all shapes of this one, counted."""
    held_out: float
    """Fall of the sum of squares of the held-out errors, in mean squares of the lack of fit."""
    inflation: float
    """Size of what is stated over that of what is seen."""

    @property
    def stands(self) -> bool:
        """Whether the effect is stated."""
        return not self.reason

    @property
    def reason(self) -> str:
        """Why it is not, in words that go after its name; empty where it is."""
        number = f"{self.blocks} {UNITS_OF[self.variable]}"
        if not self.freedom:
            return f"{number} leave nothing to test it by"
        if self.inflation > MOST_INFLATED:
            return f"as stated it would be {self.inflation:.0f} times as large as what these rows show of it"
        if self.p_value > self.chance:
            return f"{number} differ by as much without it (p = {self.p_value:.2g}; {self.chance:.1g} is asked for)"
        if self.held_out < HELD_OUT_MARGIN:
            return f"it does not predict any of {number} better from the others"
        return ""


def gathered(table: Table, trace: Trace) -> dict[str, Evidence]:
    """What speaks for every effect that must stand on evidence, by name.

    Levels drawn at random are a variance, judged as noise. A shape without a name says no more than on what something
    depends, which needs no evidence beyond that for the structure itself; but where settings differ, the shape is one
    of many.
    """
    names = dict.fromkeys(item.effect.name for item in trace.found if not item.effect.drawn)
    every = (evidence(table, trace, name) for name in names)
    return {each.name: each for each in every if each.variable == "angle" or not each.unnamed}


def settings_differ(table: Table, trace: Trace) -> "Lack":
    """By how much settings differ beyond the model and everything that was found."""
    return _lack_of_fit(_seen(table, trace, ""), table.blocks("angle"))


def evidence(table: Table, trace: Trace, name: str) -> Evidence:
    """What speaks for the effect called `name`, one of those that a trace has as columns."""
    items = [item for item in trace.found if item.effect.name == name]
    seen = _seen(table, trace, name)
    variable, block = _blocks(table, items[0], seen)
    lack = _lack_of_fit(seen, block)
    return Evidence(
        name=name,
        unnamed=isinstance(items[0].effect, Structure),
        variable=variable,
        blocks=lack.blocks,
        freedom=lack.freedom,
        p_value=lack.p_value,
        chance=min(item.candidate.chance for item in items),
        held_out=_held_out(seen, block) / lack.mean_square,
        inflation=seen.inflation,
    )


@dataclass(frozen=True, kw_only=True)
class _Seen:
    """A table as one effect is seen in it, linearised at the fit, weighted and whitened."""

    others: FloatArray
    """Orthonormal directions of the declared model and of all other effects, shape (rows, n)."""
    own: FloatArray
    """Those of the effect beside them, shape (rows, k)."""
    left: FloatArray
    """The output beside the others, shape (rows,)."""
    signal: FloatArray
    """What is stated of the effect, shape (rows,)."""
    stated: FloatArray
    """The same neither weighted nor whitened."""
    root: FloatArray
    """Roots of the weights, shape (rows,)."""

    @property
    def inflation(self) -> float:
        """Size of what is stated, a constant apart, over that of what no other column can follow."""
        centred = self.stated - np.average(self.stated, weights=self.root**2)
        shown = float(np.linalg.norm(_beside(self.others, self.signal)))
        return float(np.linalg.norm(centred * self.root)) / max(shown, 1e-300)


def _seen(table: Table, trace: Trace, name: str) -> _Seen:
    """With no effect of that name, what everything that was found leaves."""
    root, memory = np.sqrt(table.weights), table.memory.whitening(trace.noise)

    def white(columns: FloatArray) -> FloatArray:
        return memory((columns.T * root).T)

    fit = table.fit(trace.forms, trace.noise)
    coefficients = table.model.coefficients(fit.theta)
    sizes = np.split(coefficients, table.declared.shape[1] + np.cumsum([0, *_widths(trace)]))[1:-1]
    shown = [_with_tangent(table, item, size) for item, size in zip(trace.found, sizes, strict=True)]
    its = [item.effect.name == name for item in trace.found]
    linear = table.declared @ table.model.slopes(fit.theta)
    others = directions(
        white(np.column_stack([linear, *(each for each, own in zip(shown, its, strict=True) if not own)]))
    )
    own = np.column_stack([np.empty((table.rows, 0)), *(each for each, own in zip(shown, its, strict=True) if own)])
    shares = [form.columns @ size for form, size in zip(trace.forms, sizes, strict=True)]
    stated = sum((share for share, own in zip(shares, its, strict=True) if own), np.zeros(table.rows))
    rest = sum((share for share, own in zip(shares, its, strict=True) if not own), np.zeros(table.rows))
    signal = white(stated)
    left = white(table.output - table.declared @ coefficients[: table.declared.shape[1]] - rest)
    return _Seen(
        others=others,
        own=_directions_beside(others, white(own)),
        left=_beside(others, left),
        signal=signal,
        stated=stated,
        root=root,
    )


def _widths(trace: Trace) -> list[int]:
    return [int(form.columns.shape[1]) for form in trace.forms]


def _with_tangent(table: Table, item: Found, size: FloatArray) -> FloatArray:
    """Columns of an effect; what was scanned for counts as fitted."""
    change = tangent(table.scene, item, size)
    return item.form.columns if change is None else np.column_stack([item.form.columns, change])


def _directions_beside(others: FloatArray, columns: FloatArray) -> FloatArray:
    """Orthonormal directions of what is left of columns beside others."""
    length = np.linalg.norm(columns, axis=0)
    beside = _beside(others, _beside(others, columns))
    return directions(beside[:, np.linalg.norm(beside, axis=0) > _SEEN * length])


def _beside(directions_: FloatArray, columns: FloatArray) -> FloatArray:
    return np.asarray(columns - directions_ @ (directions_.T @ columns))


def directions(columns: FloatArray) -> FloatArray:
    """Orthonormal directions that columns span, shape (rows, n)."""
    length = np.linalg.norm(columns, axis=0)
    seen = length > _SEEN * length.max(initial=0.0)
    if not seen.any():
        return np.empty((len(columns), 0))
    left, values, _ = np.linalg.svd(columns[:, seen] / length[seen], full_matrices=False)
    return np.asarray(left[:, values > _SEEN * values[0]])


def _blocks(table: Table, item: Found, seen: _Seen) -> tuple[Variable, IntArray]:
    """The variable that counts, and the block of each row.

    What hardly varies within settings rests on settings, whatever it depends on: nothing else tells it from them.
    """
    setting = table.blocks("angle")
    variable = item.effect.depends_on
    if _within(seen.stated, setting) < _WITHIN or variable in ("angle", "acceleration", "direction"):
        return "angle", setting
    block = table.blocks(variable)
    return variable, _stretches(block, seen.signal) if variable == "time" else block


def _within(values: FloatArray, block: IntArray) -> float:
    """Part of the variance of values that lies within blocks."""
    mean = np.asarray(np.bincount(block, values) / np.bincount(block), dtype=float)
    within = float(np.mean((values - mean[block]) ** 2))
    return within / max(float(np.var(values)), 1e-300)


def _stretches(order: IntArray, signal: FloatArray) -> IntArray:
    """Cut rows in an order into stretches, none of which holds more than its share of the rows or of the signal."""
    rank = np.argsort(np.argsort(order, kind="stable"), kind="stable")
    energy = np.bincount(rank, signal**2)
    share = np.arange(len(order)) / len(order) + (np.cumsum(energy) - energy) / max(float(energy.sum()), 1e-300)
    number = np.floor(_STRETCHES * share / 2).astype(np.int64)
    return np.asarray(np.unique(number[rank], return_inverse=True)[1], dtype=np.int64)


@dataclass(frozen=True, kw_only=True)
class Lack:
    """What blocks differ by without a shape, and an effect against it."""

    blocks: int
    freedom: int
    mean_square: float
    """Of the lack of fit, or of the pure error where that is larger."""
    p_value: float
    """Chance of the effect without that it is there."""
    between: float
    """Mean square of the lack of fit."""
    pure: float
    """Mean square of the scatter within blocks; 0 where there are no repeats."""
    alike: float
    """Chance of so much lack of fit by the scatter within blocks; 1 where nothing can be tested."""


def _lack_of_fit(seen: _Seen, block: IntArray) -> Lack:
    explained = float(np.sum((seen.own.T @ seen.left) ** 2))
    everything = np.column_stack([seen.others, seen.own])
    rest = float(np.sum(_beside(everything, seen.left) ** 2))
    constant = not seen.own.size or _within(seen.stated, block) < _WITHIN
    level = seen.root if constant else seen.signal
    power = np.asarray(np.bincount(block, level**2), dtype=float)
    told = power > _SEEN**2 * power.max(initial=0.0)
    within = _off_blocks(np.column_stack([everything, seen.left]), level, block, np.where(told, power, np.inf))
    left, values, _ = np.linalg.svd(within[:, :-1], full_matrices=False)
    left = left[:, values > _SEEN]
    scatter = float(np.sum(_beside(left, within[:, -1]) ** 2))
    blocks, rank, width = int(np.count_nonzero(told)), left.shape[1], seen.own.shape[1]
    freedom = blocks + rank - everything.shape[1]
    spare = len(seen.left) - blocks - rank
    between = max(rest - scatter, 0.0) / freedom if freedom > 0 else 0.0
    pure = scatter / spare if spare > 0 else 0.0
    mean_square = max(between, pure, 1e-300)
    testable = freedom > 0 and width > 0
    return Lack(
        blocks=len(np.unique(block)),
        freedom=max(freedom, 0),
        mean_square=mean_square,
        p_value=float(fdtrc(width, freedom, explained / width / mean_square)) if testable else 1.0,
        between=between,
        pure=pure,
        alike=float(fdtrc(freedom, spare, between / pure)) if freedom > 0 and pure > 0 else 1.0,
    )


def _off_blocks(columns: FloatArray, level: FloatArray, block: IntArray, power: FloatArray) -> FloatArray:
    """Columns without what a number for each block, times `level`, can follow."""
    sums = np.zeros((len(power), columns.shape[1]))
    np.add.at(sums, block, level[:, None] * columns)
    return np.asarray(columns - level[:, None] * (sums / power[:, None])[block])


def _held_out(seen: _Seen, block: IntArray) -> float:
    """By how much the sum of squares of errors of blocks that are held out falls with the effect."""
    with_it = np.column_stack([seen.others, seen.own])
    return _press(seen.others, seen.left, block) - _press(with_it, seen.left, block)


def _press(directions_: FloatArray, output: FloatArray, block: IntArray) -> float:
    """Sum of squares of errors of blocks, each predicted from all the others (Allen 1974), without a refit.

    With G the part of Q'Q that a block has, the coefficients from the others are (1 - G)⁻¹ of what they show.
    """
    order = np.argsort(block, kind="stable")
    starts = np.flatnonzero(np.diff(block[order], prepend=-1))
    q, y = directions_[order], output[order]
    size = q.shape[1]
    if not size:
        return float(y @ y)
    products = np.add.reduceat(q[:, :, None] * q[:, None, :], starts)
    shown = np.add.reduceat(q * y[:, None], starts)
    kept = (1.0 + _RIDGE) * np.eye(size) - products
    coefficients = np.linalg.solve(kept, (shown.sum(axis=0) - shown)[:, :, None])[:, :, 0]
    count = np.diff(np.append(starts, len(y)))
    error = y - np.sum(q * np.repeat(coefficients, count, axis=0), axis=1)
    return float(error @ error)
