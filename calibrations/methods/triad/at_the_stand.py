"""A triad with its stand in the uncertainty of its parameters and of the correction that a user loads."""

from dataclasses import replace

from tumble.calibrations.core.propagation import TRIALS
from tumble.calibrations.methods.triad.assessed import assessed
from tumble.calibrations.methods.triad.budget import TwoAxisUncertainty
from tumble.calibrations.methods.triad.loop import TriadDeclared, TriadLoop


def declared_at(declared: TriadDeclared, stand: TwoAxisUncertainty, trials: int = TRIALS) -> TriadDeclared:
    """The declared model with what the stand adds; of a table in doubt nothing is stated."""
    if declared.doubts:
        return declared
    found = assessed(declared.model, declared.fit, declared.table, stand, trials)
    return replace(declared, fit=found.fit, model=found.model, budget=found.budget)


def loop_at(loop: TriadLoop, stand: TwoAxisUncertainty, trials: int = TRIALS) -> TriadLoop:
    """A closed loop with the same in both models; only the one with what was found is checked by simulation."""
    if loop.doubts:
        return loop
    after = assessed(loop.augmented, loop.best, loop.explained.table, stand, trials)
    return replace(
        loop,
        declared_fit=declared_at(loop.declared_fit, stand, 0),
        explained=replace(loop.explained, best=after.fit),
        augmented=after.model,
        augmented_budget=replace(after.budget, lines=(*after.budget.lines, *loop.augmented_budget.lines)),
    )
