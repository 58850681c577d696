"""A gyrocompass with its stand in the uncertainty of heading and drift."""

from dataclasses import replace

from tumble.calibrations.core.propagation import TRIALS
from tumble.calibrations.methods.gyrocompass.assessed import assessed
from tumble.calibrations.methods.gyrocompass.budget import TurntableUncertainty
from tumble.calibrations.methods.gyrocompass.loop import GyrocompassDeclared, GyrocompassLoop


def declared_at(
    declared: GyrocompassDeclared, stand: TurntableUncertainty, trials: int = TRIALS
) -> GyrocompassDeclared:
    """Heading and drift with what the stand adds; of a table in doubt nothing is stated."""
    if declared.doubts:
        return declared
    model, budget = assessed(declared.model, declared.fit, declared.table, stand, trials)
    return replace(declared, model=model, budget=budget)


def loop_at(loop: GyrocompassLoop, stand: TurntableUncertainty, trials: int = TRIALS) -> GyrocompassLoop:
    """A closed loop with the same in both models; only the one with what was found is checked by simulation."""
    if loop.doubts:
        return loop
    model, budget = assessed(loop.augmented, loop.best, loop.explained.table, stand, trials)
    return replace(
        loop,
        declared_fit=declared_at(loop.declared_fit, stand, 0),
        augmented=model,
        augmented_budget=replace(budget, lines=(*budget.lines, *loop.augmented_budget.lines)),
    )
