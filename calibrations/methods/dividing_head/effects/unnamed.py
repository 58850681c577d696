"""Structure without a name: shapes that no effect of the catalogue has, by the variable on which they depend.

They compete with the catalogue on the same terms. Where one wins, the residual is reported as unexplained, located on
its variable, and the shape stays in the model only to keep the parameters honest.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence

from tumble.calibrations.methods.dividing_head.effects import shapes
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.tracing.effect import Form, Structure, Variable, plain
from tumble.messages import Message


def _structure(
    depends_on: Variable,
    kind: str,
    forms: Callable[[Scene], Iterator[Form]],
    describe: Callable[[Mapping[str, float]], Message],
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


def _bend_of(at: Mapping[str, float]) -> Message:
    return Message(
        "a bend of the response to a{axis}, like its power {power:g}",
        axis="xyz"[int(at["axis"])],
        power=at["order"] if "order" in at else at["power"],
    )


def _since(at: Mapping[str, float]) -> Message:
    ((group, dwells),) = at.items()
    if group == "table":
        return Message("a steady course with the number of dwells over the table, which has no time")
    since = (
        Message("the start of each realisation") if group == "realisation" else Message("the start of each mounting")
    )
    if dwells == 1.0:
        return Message("a steady course since {since}", since=since)
    return Message("something that dies out within some {dwells:g} dwells of {since}", dwells=dwells, since=since)


def _after_moves(at: Mapping[str, float]) -> Message:
    if "bias" in at:
        return Message("another bias after moves in - direction")
    return Message("another response after moves in - direction")


def _against_temperature(at: Mapping[str, float]) -> Message:
    if "rate" in at:
        return Message("a dependence on how fast the temperature changes")
    return Message("a course against temperature of no simple shape")


def withheld_by(name: str, at: Mapping[str, float]) -> tuple[str, ...]:
    """Parameters that are not identifiable with a shape that could be them as well.

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
        lambda at: Message(
            "a bump of the head's error near {centre_deg:g}°, some {width_deg:g}° wide",
            centre_deg=at["centre_deg"],
            width_deg=2 * at["width_deg"],
        ),
    ),
    _structure(
        "angle",
        "course",
        shapes.head_course,
        lambda _: Message("an error of the head of no simple shape round the circle"),
    ),
    _structure("acceleration", "bend", shapes.polynomials, _bend_of),
    _structure(
        "acceleration",
        "zone",
        shapes.zones,
        lambda at: Message("another slope of the response within {width_g:g} g of ax = 0", width_g=at["width_g"]),
    ),
    _structure(
        "acceleration",
        "bump",
        shapes.bumps,
        lambda at: Message(
            "a bump of the output near ax = {centre_g:.2f} g, some {width_g:.2g} g wide",
            centre_g=at["centre_g"],
            width_g=2 * at["width_g"],
        ),
    ),
    _structure(
        "acceleration",
        "course",
        shapes.response_course,
        lambda _: Message("a bend of the response to ax of no simple shape"),
    ),
    _structure(
        "time",
        "bend",
        shapes.time_bends,
        lambda at: Message("a drift that bends, like the power {power:g} of the time", power=at["power"]),
    ),
    _structure(
        "time",
        "period",
        shapes.time_periods,
        lambda at: Message("a wave in time with a period of {period_s:.0f} s", period_s=at["period_s"]),
    ),
    _structure(
        "time",
        "step",
        shapes.time_steps,
        lambda at: Message("a step some {step_s:.0f} s after the first row", step_s=at["step_s"]),
    ),
    _structure("time", "course", shapes.time_course, lambda _: Message("a course in time of no simple shape")),
    _structure(
        "temperature",
        "bend",
        shapes.temperature_bends,
        lambda at: Message("a bend against temperature, like the power {power:g}", power=at["power"]),
    ),
    _structure(
        "temperature",
        "step",
        shapes.temperature_steps,
        lambda at: Message("a transition near a temperature of {at_degc:.1f} °C", at_degc=at["at_degc"]),
    ),
    _structure(
        "temperature",
        "course",
        shapes.temperature_course,
        _against_temperature,
    ),
    _structure(
        "direction",
        "of approach",
        shapes.directions,
        _after_moves,
    ),
    _structure(
        "realisation",
        "alone",
        shapes.realisations,
        lambda at: Message("realisation {realisation:g} responds differently", realisation=at["realisation"]),
    ),
    _structure("order", "of dwells", shapes.orders, _since),
)
