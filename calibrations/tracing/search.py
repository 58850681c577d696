"""Finds the set of effects that explains a table. Several are followed at once, so that a first guess can be wrong."""

from collections import Counter
from collections.abc import Iterable, Sequence

import numpy as np

from tumble.calibrations.tracing.candidates import Candidate
from tumble.calibrations.tracing.problem import Explanation, Problem

BEAM = 6
"""How many sets are followed."""
BRANCHES = 5
"""How many ways each is continued."""
_HOPELESS = 8.0
"""Where one effect more costs so much beyond what it explains, no further ones are looked for."""


def search(problem: Problem, beam: int = BEAM) -> Explanation:
    """The set of candidates with the lowest price: deviance plus what each effect must earn to be believed.

    `beam` is how many sets are followed; with one, effects are added one by one.
    """
    nothing = problem.explain(())
    best, followed = nothing, [nothing]
    for _ in range(problem.most):
        followed = _continued(problem, followed, beam)
        if not followed:
            break
        if price(problem, followed[0]) < price(problem, best):
            best = followed[0]
        elif price(problem, followed[0]) > price(problem, best) + _HOPELESS:
            break
    return settled(problem, best)


def price(problem: Problem, explanation: Explanation) -> float:
    """Deviance plus the entry of every effect."""
    return explanation.deviance + entries([problem.offered[number] for number in explanation.chosen])


def entries(chosen: Sequence[Candidate]) -> float:
    """What effects must earn together; the second form of an effect earns less than another effect."""
    total, seen = 0.0, set()
    for candidate in chosen:
        total += candidate.again if candidate.effect.name in seen else candidate.entry
        seen.add(candidate.effect.name)
    return total


def settled(problem: Problem, explanation: Explanation) -> Explanation:
    """Add, drop and exchange effects as long as that lowers the price."""
    while True:
        trials = [
            *_added(problem, explanation),
            *_dropped(problem, explanation),
            *_exchanged(problem, explanation),
        ]
        better = min(trials, key=lambda trial: price(problem, trial), default=explanation)
        if price(problem, better) >= price(problem, explanation) - 1e-6:
            return explanation
        explanation = better


def _continued(problem: Problem, followed: Iterable[Explanation], beam: int) -> list[Explanation]:
    """The best sets with one effect more than those that were followed.

    Which are worth a fit is judged by the linearised gains.
    """
    expected: dict[frozenset[int], tuple[float, Explanation, int]] = {}
    for explanation in followed:
        before = price(problem, explanation)
        for worth, number in _promising(problem, explanation, BRANCHES if explanation.chosen else 3 * BRANCHES):
            key = frozenset((*explanation.chosen, number))
            if key not in expected or before - worth < expected[key][0]:
                expected[key] = (before - worth, explanation, number)
    likely = sorted(expected.values(), key=lambda trial: trial[0])[: 2 * beam]
    found = [problem.explain((*from_.chosen, number)) for _, from_, number in likely]
    return sorted(found, key=lambda explanation: price(problem, explanation))[:beam]


def _promising(problem: Problem, explanation: Explanation, count: int) -> list[tuple[float, int]]:
    """The best form of each of the effects that promise most: by how much it would lower the price, and its number.

    An effect of several forms may be taken twice: its real shape need not be one of those in the catalogue.
    """
    worth = problem.gains(explanation) - problem.entries
    present = Counter(problem.offered[number].effect.name for number in explanation.chosen)
    for name, times in present.items():
        forms = problem.forms[name]
        worth[forms] += problem.entries[forms] - problem.entries_again[forms] if times < 2 else -np.inf
    worth[list(explanation.chosen)] = -np.inf
    ranked = sorted(((float(worth[number]), number) for number in problem.best_forms(worth)), reverse=True)
    return [(value, number) for value, number in ranked[:count] if value > -15.0]


def _added(problem: Problem, explanation: Explanation) -> list[Explanation]:
    """Every set with one of the few that promise most added."""
    if len(explanation.chosen) >= problem.most:
        return []
    promising = [number for worth, number in _promising(problem, explanation, BRANCHES) if worth > -_HOPELESS]
    return [problem.explain((*explanation.chosen, number)) for number in promising]


def _dropped(problem: Problem, explanation: Explanation) -> list[Explanation]:
    chosen = explanation.chosen
    return [problem.explain(chosen[:place] + chosen[place + 1 :]) for place in range(len(chosen))]


def _exchanged(problem: Problem, explanation: Explanation) -> list[Explanation]:
    """Every effect exchanged for each of the few that promise most in its place, or for another form of its own."""
    exchanged = []
    for place in range(len(explanation.chosen)):
        chosen = explanation.chosen[:place] + explanation.chosen[place + 1 :]
        without = problem.explain(chosen)
        for _, number in _promising(problem, without, BRANCHES):
            exchanged.append(problem.explain((*without.chosen, number)))
    return exchanged
