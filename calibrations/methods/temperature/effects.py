"""What a parameter may do with temperature, beyond being constant: bend as a polynomial, break, step; or drift."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from tumble.calibrations.methods.temperature.scene import RunScene
from tumble.calibrations.tracing.effect import Effect, Form, Forms, plain, scan, single, with_scanned
from tumble.messages import Message

POLYNOMIALS: Final = (
    Message.named("temperature_linear", "linear temperature dependence"),
    Message.named("temperature_quadratic", "quadratic temperature dependence"),
    Message.named("temperature_cubic", "cubic temperature dependence"),
    Message.named("temperature_quartic", "quartic temperature dependence"),
)
"""By their degree, from 1."""
BREAK: Final = Message.named("temperature_break", "break in the temperature dependence")
STEP: Final = Message.named("temperature_step", "step in the temperature dependence")
HYSTERESIS: Final = Message.named("temperature_hysteresis", "temperature hysteresis")
DRIFT: Final = Message.named("run_drift", "drift from run to run")
_FEWEST_BOTH_WAYS = 3
"""So many temperatures must show heating and cooling: a gap at one or two of them is any error of those."""
CUBIC: Final = POLYNOMIALS[:3]
"""What a cubic consists of."""
_EXPECTED = 8.0
"""Penalty that a polynomial is spared: that it follows temperature smoothly is what anyone expects. With thirteen
runs it is then believed at a chance of one in a hundred, as a term that is added to a fit usually is."""
_DOUBT = 6.0
"""Doubt in a drift from run to run where each run has a temperature of its own: that is the better guess."""


def _power(order: int) -> Forms[RunScene]:
    """Chebyshev's polynomial over the range, where there are runs enough for it."""

    def forms(scene: RunScene) -> Sequence[Form]:
        if len(scene.known_degc) < order + 3:
            return ()
        column = np.polynomial.Chebyshev.basis(order)(scene.relative)
        return (Form(columns=column[:, None], penalty=-_EXPECTED),)

    return forms


def _break(scene: RunScene, at_degc: float) -> Form:
    """Another slope above a temperature."""
    column = np.clip(scene.temperature_degc - at_degc, 0.0, None)
    return Form(columns=column[:, None], scanned={"at_degC": at_degc})


def _steps(scene: RunScene) -> Sequence[Form]:
    """Another level above a temperature, half way between two runs."""
    known = scene.known_degc
    places = ((known[1:] + known[:-1]) / 2)[1:-1]
    return [
        Form(columns=(scene.temperature_degc > at_degc).astype(float)[:, None], scanned={"at_degC": float(at_degc)})
        for at_degc in places
    ]


def _hysteresis(scene: RunScene) -> Sequence[Form]:
    """Half above and half below, where some temperatures were reached by heating and by cooling."""
    return single(scene.direction / 2.0) if scene.both_ways >= _FEWEST_BOTH_WAYS else ()


def _order(scene: RunScene) -> Sequence[Form]:
    return (Form(columns=(scene.order - 1.0)[:, None], penalty=_DOUBT),)


def run_effects(unit: str) -> tuple[Effect[RunScene], ...]:
    """All of them, for a parameter in this unit. Coefficients of polynomials are shares at the end of the range."""
    polynomials = [
        Effect(
            name=name,
            depends_on="temperature",
            belongs_to="unit",
            symbol=f"c T_{order}",
            source=Message("polynomial of Chebyshev over the range of the runs"),
            forms=_power(order),
            report=plain(name, unit),
        )
        for order, name in enumerate(POLYNOMIALS, start=1)
    ]
    return (
        *polynomials,
        Effect(
            name=BREAK,
            depends_on="temperature",
            belongs_to="unit",
            symbol="c max(0, T - T_b)",
            source=Message("a part that comes to its stop, a glass transition, an adhesive that softens"),
            forms=scan(_break, lambda scene: scene.between_degc.tolist()),
            report=with_scanned(plain("slope", f"{unit}/K"), at_degC="degC"),
            at=_break,
        ),
        Effect(
            name=STEP,
            depends_on="temperature",
            belongs_to="unit",
            symbol=Message("c above T_s"),
            source=Message("a contact or a part that slips"),
            forms=_steps,
            report=with_scanned(plain("step", unit), at_degC="degC"),
        ),
        Effect(
            name=HYSTERESIS,
            depends_on="direction",
            belongs_to="unit",
            symbol=Message("c after heating - after cooling"),
            source=Message("stress that stays after a change of temperature"),
            forms=_hysteresis,
            report=plain(HYSTERESIS, unit),
        ),
        Effect(
            name=DRIFT,
            depends_on="order",
            belongs_to="unit",
            symbol=Message("c run"),
            source=Message("ageing from run to run"),
            forms=_order,
            report=plain(DRIFT, f"{unit}/run"),
        ),
    )
