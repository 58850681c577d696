"""Structure without a name: shapes that no effect of the catalogue has, by the variable on which they depend.

They compete with the catalogue on the same terms. Where one wins, the residual is reported as unexplained, located on
its variable, and the shape stays in the model only to keep the parameters honest.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence

from tumble.calibrations.methods.dividing_head.effects import shapes
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.tracing.effect import Form, Structure, Variable, plain


def _structure(
    depends_on: Variable,
    kind: str,
    forms: Callable[[Scene], Iterator[Form]],
    describe: Callable[[Mapping[str, float]], str],
) -> Structure[Scene]:
    def listed(scene: Scene) -> Sequence[Form]:
        return tuple(forms(scene))

    return Structure(
        name=f"?{depends_on} {kind}",
        belongs_to="unit",
        symbol="",
        source="",
        forms=listed,
        report=plain("amplitude", "V"),
        depends_on=depends_on,
        describe=lambda form: describe(form.scanned),
    )


def _bend_of(at: Mapping[str, float]) -> str:
    axis = "xyz"[int(at["axis"])]
    return f"a bend of the response to a{axis}, like its power {at.get('order', at.get('power')):g}"


def _since(at: Mapping[str, float]) -> str:
    ((group, dwells),) = at.items()
    if group == "table":
        return "a steady course with the number of dwells over the table, which has no time"
    since = "realisation" if group == "realisation" else "mounting"
    return (
        f"a steady course since the start of each {since}"
        if dwells == 1.0
        else (f"something that dies out within some {dwells:g} dwells of the start of each {since}")
    )


def withheld_by(name: str, at: Mapping[str, float]) -> tuple[str, ...]:
    """Parameters that have no meaning beside a shape that could be them as well.

    A bend has a slope or a mean of its own, and of two realisations nobody knows which is the odd one.
    """
    if name == "?acceleration bend" and "order" in at:
        return (f"k{'xyz'[int(at['axis'])]}",) if at["order"] % 2 else ("u0",)
    around_zero = ("u0", "kx")
    return {
        "?angle course": ("alpha0",),
        "?acceleration bend": around_zero,
        "?acceleration course": around_zero,
        "?realisation alone": ("kx",),
    }.get(name, ())


STRUCTURES: tuple[Structure[Scene], ...] = (
    _structure(
        "angle",
        "bell",
        shapes.head_bells,
        lambda at: f"a bump of the head's error near {at['centre_deg']:g}°, some {2 * at['width_deg']:g}° wide",
    ),
    _structure(
        "angle", "course", shapes.head_course, lambda _: "an error of the head of no simple shape round the circle"
    ),
    _structure("acceleration", "bend", shapes.polynomials, _bend_of),
    _structure(
        "acceleration",
        "zone",
        shapes.zones,
        lambda at: f"another slope of the response within {at['width_g']:g} g of ax = 0",
    ),
    _structure(
        "acceleration",
        "bump",
        shapes.bumps,
        lambda at: f"a bump of the output near ax = {at['centre_g']:.2f} g, some {2 * at['width_g']:.2g} g wide",
    ),
    _structure(
        "acceleration", "course", shapes.response_course, lambda _: "a bend of the response to ax of no simple shape"
    ),
    _structure(
        "time", "bend", shapes.time_bends, lambda at: f"a drift that bends, like the power {at['power']:g} of the time"
    ),
    _structure(
        "time", "period", shapes.time_periods, lambda at: f"a wave in time with a period of {at['period_s']:.0f} s"
    ),
    _structure("time", "step", shapes.time_steps, lambda at: f"a step some {at['step_s']:.0f} s after the first row"),
    _structure("time", "course", shapes.time_course, lambda _: "a course in time of no simple shape"),
    _structure(
        "temperature",
        "bend",
        shapes.temperature_bends,
        lambda at: f"a bend against temperature, like the power {at['power']:g}",
    ),
    _structure(
        "temperature",
        "step",
        shapes.temperature_steps,
        lambda at: f"a transition near a temperature of {at['at_degc']:.1f} °C",
    ),
    _structure(
        "temperature",
        "course",
        shapes.temperature_course,
        lambda at: (
            "a dependence on how fast the temperature changes"
            if "rate" in at
            else "a course against temperature of no simple shape"
        ),
    ),
    _structure(
        "direction",
        "of approach",
        shapes.directions,
        lambda at: f"another {'bias' if 'bias' in at else 'response'} after moves in - direction",
    ),
    _structure(
        "realisation",
        "alone",
        shapes.realisations,
        lambda at: f"realisation {at['realisation']:g} responds differently",
    ),
    _structure("order", "of dwells", shapes.orders, _since),
)
