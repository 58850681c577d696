"""What was found, graded by the rule of `close_loop`: names found and names there pair up one to one."""

from collections.abc import Sequence

from benchmarks.loop.matching import is_exact
from tumble.calibrations.tracing.findings import EffectFound, Unexplained


def exact_by_name(true_effects: Sequence[str], names: Sequence[str], unexplained: Unexplained | None = None) -> bool:
    """Whether just the right names were found."""
    return is_exact(true_effects, {}, [_found(name, ()) for name in names], unexplained)


def exact_up_to_aliases(
    true_effects: Sequence[str],
    names: Sequence[str],
    aliases: Sequence[frozenset[str]],
    unexplained: Unexplained | None = None,
) -> bool:
    """The same where a name may stand for any of its aliases.

    Parameters
    ----------
    aliases
        Sets of effects that the table cannot tell apart.
    """
    return is_exact(true_effects, {}, [_found(name, _also(name, aliases)) for name in names], unexplained)


def aliases_of(effects: Sequence[EffectFound]) -> tuple[frozenset[str], ...]:
    """What `close_loop` says cannot be told apart: every effect with its rivals."""
    return tuple(frozenset((effect.name, *effect.also_possible)) for effect in effects)


def _also(name: str, aliases: Sequence[frozenset[str]]) -> tuple[str, ...]:
    return tuple(sorted(frozenset().union(*(alike for alike in aliases if name in alike)) - {name}))


def _found(name: str, also_possible: tuple[str, ...]) -> EffectFound:
    return EffectFound(name=name, also_possible=also_possible, belongs_to="unit", coefficients={}, p_value=0.0)
