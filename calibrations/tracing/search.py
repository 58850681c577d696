"""Finds the set of effects that explains a table. Several are followed at once, so that a first guess can be wrong."""

from collections import Counter
from collections.abc import Iterable, Sequence

from calibrations.tracing.candidates import Candidate
from calibrations.tracing.problem import Explanation, Problem

BEAM = 6
"""How many sets are followed."""
BRANCHES = 5
"""How many ways each is continued."""
MOST = 5
"""How many effects are looked for at most."""


def search(problem: Problem, most: int = MOST) -> Explanation:
    """The set of candidates with the lowest price: deviance plus what each effect must earn to be believed."""
    nothing = problem.explain(())
    best, followed = nothing, [nothing]
    for _ in range(most):
        followed = _continued(problem, followed)
        if not followed:
            break
        if price(problem, followed[0]) < price(problem, best):
            best = followed[0]
        elif price(problem, followed[0]) > price(problem, best) + 30.0:
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
    """Drop and exchange effects as long as that lowers the price."""
    while True:
        trials = [*_dropped(problem, explanation), *_exchanged(problem, explanation)]
        better = min(trials, key=lambda trial: price(problem, trial), default=explanation)
        if price(problem, better) >= price(problem, explanation) - 1e-6:
            return explanation
        explanation = better


def _continued(problem: Problem, followed: Iterable[Explanation]) -> list[Explanation]:
    """The best sets with one effect more than those that were followed."""
    found: dict[frozenset[int], Explanation] = {}
    for explanation in followed:
        for number in _promising(problem, explanation, BRANCHES if explanation.chosen else 3 * BRANCHES):
            key = frozenset((*explanation.chosen, number))
            if key not in found:
                found[key] = problem.explain((*explanation.chosen, number), explanation.fit.theta[:6])
    return sorted(found.values(), key=lambda explanation: price(problem, explanation))[:BEAM]


def _promising(problem: Problem, explanation: Explanation, count: int) -> list[int]:
    """The best form of each of the effects that promise most.

    An effect of several forms may be taken twice: its real shape need not be one of those in the catalogue.
    """
    gains = problem.gains(explanation)
    present = Counter(problem.offered[number].effect.name for number in explanation.chosen)
    best: dict[str, tuple[float, int]] = {}
    for number, candidate in enumerate(problem.offered):
        name = candidate.effect.name
        entry = candidate.again if present[name] else candidate.entry
        worth = (float(gains[number]) - entry, number)
        if number not in explanation.chosen and present[name] < 2 and worth > best.get(name, (float("-inf"), -1)):
            best[name] = worth
    ranked = sorted(best.values(), reverse=True)
    return [number for worth, number in ranked[:count] if worth > -15.0]


def _dropped(problem: Problem, explanation: Explanation) -> list[Explanation]:
    chosen = explanation.chosen
    near = explanation.fit.theta[:6]
    return [problem.explain(chosen[:place] + chosen[place + 1 :], near) for place in range(len(chosen))]


def _exchanged(problem: Problem, explanation: Explanation) -> list[Explanation]:
    """Every effect exchanged for each of the few that promise most in its place, or for another form of its own."""
    exchanged = []
    for place in range(len(explanation.chosen)):
        chosen = explanation.chosen[:place] + explanation.chosen[place + 1 :]
        without = problem.explain(chosen, explanation.fit.theta[:6])
        for number in _promising(problem, without, BRANCHES):
            exchanged.append(problem.explain((*without.chosen, number), without.fit.theta[:6]))
    return exchanged
