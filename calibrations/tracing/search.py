"""Finds the set of effects that explains a table. Several are followed at once, so that a first guess can be wrong."""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from tumble.calibrations.tracing.candidates import Candidate
from tumble.calibrations.tracing.pairs import best_pair
from tumble.calibrations.tracing.problem import Explanation, Problem

BEAM = 12
"""How many sets are followed."""
BRANCHES = 5
"""How many ways each is continued."""
_ALIKE = 6
"""Decimals of a deviance: what differs beyond them is rounding, and of two alike that offered first is taken."""
_HOPELESS = 8.0
"""Where one effect more costs so much beyond what it explains, no further ones are looked for."""


def search(problem: Problem, beam: int = BEAM) -> Explanation:
    """The set of candidates with the lowest penalised deviance: deviance plus penalties.

    `beam` is how many sets are followed; with one, effects are added one by one.
    """
    best = problem.explain(())
    for followed in _followed(problem, beam):
        best = min(best, followed[0], key=lambda each: penalised(problem, each))
    return settled(problem, best)


def runners_up(problem: Problem) -> Iterator[Explanation]:
    """The sets that a search follows, the cheapest first; of sets of the same effects the first."""
    sets = [explanation for followed in _followed(problem, BEAM) for explanation in followed]
    seen = set[frozenset[str]]()
    for explanation in sorted(sets, key=lambda each: _rank(problem, each)):
        names = frozenset(problem.offered[number].effect.name for number in explanation.chosen)
        if names not in seen:
            seen.add(names)
            yield explanation


def _followed(problem: Problem, beam: int) -> Iterator[list[Explanation]]:
    """The best sets of one effect, of two, and so on, each the best first."""
    nothing = problem.explain(())
    least, followed = penalised(problem, nothing), [nothing]
    for _ in range(problem.most):
        followed = _continued(problem, followed, beam)
        if not followed:
            return
        yield followed
        cost = penalised(problem, followed[0])
        if cost > least + _HOPELESS:
            return
        least = min(least, cost)


def penalised(problem: Problem, explanation: Explanation) -> float:
    """Deviance plus the entry of every effect."""
    return explanation.deviance + penalties([problem.offered[number] for number in explanation.chosen])


def penalties(chosen: Sequence[Candidate]) -> float:
    """Penalty of effects together; that of the second form of an effect is smaller than that of another effect."""
    total, seen = 0.0, set()
    for candidate in chosen:
        total += candidate.repeat_penalty if candidate.effect.name in seen else candidate.penalty
        seen.add(candidate.effect.name)
    return total


def begun_anew(problem: Problem, explanation: Explanation) -> Explanation:
    """Exchange all that depends on a variable for the best two given shapes of it at once, if that is better.

    Step by step a wave and a step of one voltage are each put where the other is missing, and curves added to that.
    """
    better = min(_others(problem, explanation), key=lambda trial: _rank(problem, trial), default=explanation)
    return min(explanation, better, key=lambda each: penalised(problem, each))


def _others(problem: Problem, explanation: Explanation) -> Iterator[Explanation]:
    effects = [candidate.effect for candidate in problem.offered]
    for variable in dict.fromkeys(effects[number].depends_on for number in explanation.chosen):
        given = [number for number, each in enumerate(effects) if each.given and each.depends_on == variable]
        rest = tuple(number for number in explanation.chosen if effects[number].depends_on != variable)
        if pair := best_pair(problem, problem.explain(rest), given):
            yield settled(problem, problem.explain((*rest, *pair)))


def settled(problem: Problem, explanation: Explanation) -> Explanation:
    """Add, drop and exchange effects as long as that lowers the penalised deviance.

    Where nothing does any more, each effect is dropped once while the others may take other forms of theirs.
    """
    for trials in (_by_one, _without_one):
        better = min(trials(problem, explanation), key=lambda trial: _rank(problem, trial), default=explanation)
        if penalised(problem, better) < penalised(problem, explanation) - 1e-6:
            return settled(problem, better)
    return explanation


def _by_one(problem: Problem, explanation: Explanation) -> list[Explanation]:
    return [*_added(problem, explanation), *_dropped(problem, explanation), *_exchanged(problem, explanation)]


def _without_one(problem: Problem, explanation: Explanation) -> list[Explanation]:
    return [_in_best_forms(problem, rest) for rest in _dropped(problem, explanation)]


def _in_best_forms(problem: Problem, explanation: Explanation) -> Explanation:
    """The same effects, one after the other in the form that explains most beside the others."""
    for place, number in enumerate(explanation.chosen):
        chosen = explanation.chosen[:place] + explanation.chosen[place + 1 :]
        forms = problem.forms[problem.offered[number].effect.name]
        gains = problem.gains(problem.explain(chosen))[forms]
        other = problem.explain((*chosen[:place], forms.start + int(gains.argmax()), *chosen[place:]))
        explanation = min(explanation, other, key=lambda each: penalised(problem, each))
    return explanation


def _continued(problem: Problem, followed: Iterable[Explanation], beam: int) -> list[Explanation]:
    """The best sets with one effect more than those that were followed.

    Which are worth a fit is judged by the linearised gains.
    """
    expected: dict[frozenset[int], tuple[float, Explanation, int]] = {}
    for explanation in followed:
        before = penalised(problem, explanation)
        for worth, number in _promising(problem, explanation, BRANCHES if explanation.chosen else 3 * BRANCHES):
            key = frozenset((*explanation.chosen, number))
            if key not in expected or before - worth < expected[key][0]:
                expected[key] = (before - worth, explanation, number)
    likely = sorted(expected.values(), key=lambda trial: (round(trial[0], _ALIKE), trial[2]))[: 2 * beam]
    found = [problem.explain((*from_.chosen, number)) for _, from_, number in likely]
    return sorted(found, key=lambda explanation: _rank(problem, explanation))[:beam]


def _rank(problem: Problem, explanation: Explanation) -> tuple[float, list[int]]:
    """Sorts explanations, the best one first."""
    return round(penalised(problem, explanation), _ALIKE), sorted(explanation.chosen)


def _promising(problem: Problem, explanation: Explanation, count: int) -> list[tuple[float, int]]:
    """The best form of each of the effects that promise most: what it would gain, and its number.

    An effect of several forms may be taken twice where its real shape need not be one of those in the catalogue.
    """
    worth = problem.gains(explanation) - problem.penalties
    present = Counter(problem.offered[number].effect.name for number in explanation.chosen)
    for name, times in present.items():
        forms = problem.forms[name]
        again = times < 2 and not problem.offered[forms.start].effect.given
        worth[forms] += problem.penalties[forms] - problem.repeat_penalties[forms] if again else -np.inf
    worth[list(explanation.chosen)] = -np.inf
    told = [(float(worth[number]), number) for number in problem.best_forms(worth)]
    ranked = sorted(told, key=lambda each: (-round(each[0], _ALIKE), each[1]))
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
