"""Vibrated dwells with their stand in the uncertainty of the coefficients."""

from dataclasses import replace

from tumble.calibrations.methods.vibration.budget import VibrationUncertainty, budgeted
from tumble.calibrations.methods.vibration.loop import VibrationDeclared, VibrationLoop


def declared_at(declared: VibrationDeclared, stand: VibrationUncertainty) -> VibrationDeclared:
    """The declared model with what the stand adds."""
    model, budget = budgeted(declared.model, declared.fit.dwell, stand)
    return replace(declared, model=model, budget=budget)


def loop_at(loop: VibrationLoop, stand: VibrationUncertainty) -> VibrationLoop:
    """A closed loop with the same in both models."""
    model, budget = budgeted(loop.augmented, loop.best.dwell, stand)
    return replace(
        loop,
        declared_fit=declared_at(loop.declared_fit, stand),
        augmented=model,
        augmented_budget=replace(budget, lines=(*budget.lines, *loop.augmented_budget.lines)),
    )
