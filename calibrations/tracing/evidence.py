"""On what an effect rests: how many blocks of the variable on which it depends, and whether it holds in them.

Repeats carry no evidence of a shape: rows that share a value of the variable (a setting, a stretch of time, a visit of
a temperature) are one block. Three things are asked of every effect, beside everything else that was found:

- *Among blocks* it explains more than what blocks differ by without a shape: the F test of its mean square against that
  of the lack of fit of the blocks, with the freedom of the blocks, not of the rows (Draper and Smith, 2.1). What is
  allowed to differ is a level of each block where the effect is one number in each, else its size in each.
- *Held out*: rows of a whole block are predicted better from all other blocks with the effect than without it.
- *Resolved*: what is stated of it is not many times what of it is orthogonal to the model. A shape is known to a per
  cent at best; if x is what is stated and s what of it no other column can follow, an error ε |x| of the shape changes
  its size by up to ε |x|/|s|. With ε = 1 % and |x| = 30 |s| that is 30 %: beyond it no more than an order of magnitude
  is left.
"""

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.blocks import WITHIN, Lack, held_out_gain, lack_of_fit, within
from tumble.calibrations.tracing.effect import Structure, Variable
from tumble.calibrations.tracing.linearised import Linearised, PartialRegression
from tumble.calibrations.tracing.table import Table
from tumble.calibrations.tracing.trace import Found, Trace
from tumble.messages import Message

MOST_INFLATED: Final = 30.0
"""So many times larger than its part orthogonal to the model an effect may be; see above."""
HELD_OUT_MARGIN: Final = 4.0
"""The sum of squares of held-out errors must fall by so many mean squares of the lack of fit: by two deviations."""
_STRETCHES: Final = 24
"""Into so many stretches of time a table is cut; where most of the effect is, it is cut finer."""
IntArray = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True)
class Evidence:
    """What speaks for one effect of a trace."""

    name: str
    unnamed: bool
    variable: Variable
    """The variable whose blocks count."""
    blocks: int
    """Distinct settings, stretches, visits."""
    counted: Message
    """The same in words: `7 settings`."""
    freedom: int
    """Blocks that are left beside everything that is fitted; nothing can be tested with none."""
    p_value: float
    """Chance of so much among the blocks; 1 where nothing can be tested."""
    chance: float
    """At which the effect is believed: all effects, and all shapes of this one, counted."""
    held_out: float
    """Fall of the sum of squares of the held-out errors, in mean squares of the lack of fit."""
    inflation: float
    """Size of what is stated over that of its part orthogonal to the model."""

    @property
    def stands(self) -> bool:
        """Whether the effect is stated."""
        return not self.reason

    @property
    def reason(self) -> str:
        """Why it is not, in words that go after its name; empty where it is."""
        if not self.freedom:
            return Message("{blocks} leave nothing to test it by", blocks=self.counted)
        if self.inflation > MOST_INFLATED:
            return Message(
                "as stated it would be {times:.0f} times as large as what these rows show of it", times=self.inflation
            )
        if self.p_value > self.chance:
            return Message(
                "{blocks} differ by as much without it (p = {p_value:.2g}; {chance:.1g} is asked for)",
                blocks=self.counted,
                p_value=self.p_value,
                chance=self.chance,
            )
        if self.held_out < HELD_OUT_MARGIN:
            return Message("it does not predict any of {blocks} better from the others", blocks=self.counted)
        return ""


def gathered(table: Table, trace: Trace) -> dict[str, Evidence]:
    """What speaks for every effect that must stand on evidence, by name.

    Random effects are a variance, judged as noise. A shape without a name says no more than on what something
    depends, which needs no evidence beyond that for the structure itself; but where settings differ, the shape is one
    of many.
    """
    names = dict.fromkeys(item.effect.name for item in trace.found if not item.effect.random)
    linearised = Linearised(table, trace)
    every = (_evidence(linearised, name) for name in names)
    return {each.name: each for each in every if each.variable == "angle" or not each.unnamed}


def settings_differ(table: Table, trace: Trace) -> Lack:
    """By how much settings differ beyond the model and everything that was found; untested where nothing is traced."""
    lack = lack_of_fit(Linearised(table, trace).partial(""), table.blocks("angle"))
    return replace(lack, alike=1.0) if table.not_traced else lack


def evidence(table: Table, trace: Trace, name: str) -> Evidence:
    """What speaks for the effect called `name`, one of those that a trace has as columns."""
    return _evidence(Linearised(table, trace), name)


def _evidence(linearised: Linearised, name: str) -> Evidence:
    items = [item for item in linearised.trace.found if item.effect.name == name]
    partial = linearised.partial(name)
    variable, block = _blocks(linearised.table, items[0], partial)
    lack = lack_of_fit(partial, block)
    return Evidence(
        name=name,
        unnamed=isinstance(items[0].effect, Structure),
        variable=variable,
        blocks=lack.blocks,
        counted=linearised.table.counted_blocks(variable, lack.blocks),
        freedom=lack.freedom,
        p_value=lack.p_value,
        chance=min(item.candidate.chance for item in items),
        held_out=held_out_gain(partial, block) / lack.mean_square,
        inflation=partial.inflation,
    )


def _blocks(table: Table, item: Found, partial: PartialRegression) -> tuple[Variable, IntArray]:
    """The variable that counts, and the block of each row.

    What hardly varies within settings rests on settings, whatever it depends on: nothing else tells it from them.
    """
    setting = table.blocks("angle")
    variable = item.effect.depends_on
    if within(partial.stated, setting) < WITHIN or variable in ("angle", "acceleration", "direction"):
        return "angle", setting
    block = table.blocks(variable)
    return variable, _stretches(block, partial.signal) if variable == "time" else block


def _stretches(order: IntArray, signal: FloatArray) -> IntArray:
    """Cut rows in an order into stretches, none of which holds more than its share of the rows or of the signal."""
    rank = np.argsort(np.argsort(order, kind="stable"), kind="stable")
    energy = np.bincount(rank, signal**2)
    share = np.arange(len(order)) / len(order) + (np.cumsum(energy) - energy) / max(float(energy.sum()), 1e-300)
    number = np.floor(_STRETCHES * share / 2).astype(np.int64)
    return np.asarray(np.unique(number[rank], return_inverse=True)[1], dtype=np.int64)
