"""Whether a table was traced to exactly what was put in."""

from collections.abc import Mapping, Sequence
from itertools import permutations

from tumble.calibrations.tracing.findings import EffectFound, Unexplained


def is_exact(
    true_effects: Sequence[str],
    novel: Mapping[str, str],
    found: Sequence[EffectFound],
    unexplained: Unexplained | None,
) -> bool:
    """Judge a result.

    Parameters
    ----------
    true_effects
        Names of the effects of the catalogue that are there.
    novel
        Effects outside the catalogue that are there, with what each depends on.
    found
        Effects that were reported.
    unexplained
        Structure that was reported.
    """
    return _pairs_up(true_effects, found) and _rightly_unexplained(novel, unexplained)


def _pairs_up(true_effects: Sequence[str], found: Sequence[EffectFound]) -> bool:
    """Whether effects reported and effects there can be paired one to one, under a name or as its rival."""
    if len(true_effects) != len(found):
        return False
    return any(
        all(name == effect.name or name in effect.also_possible for name, effect in zip(order, found, strict=True))
        for order in permutations(true_effects)
    )


def _rightly_unexplained(novel: Mapping[str, str], unexplained: Unexplained | None) -> bool:
    if unexplained is None or not novel:
        return unexplained is None and not novel
    return unexplained.depends_on in novel.values()
