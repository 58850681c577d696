"""What is shown of the noise of a recording."""

from collections.abc import Iterator

from tumble.calibrations.allan.averaging import BestTime
from tumble.calibrations.allan.coefficients import Coefficient
from tumble.calibrations.allan.figures import allan_figure
from tumble.calibrations.allan.result import AllanResult, OutputNoise
from tumble.calibrations.core.quantities import format_concise, format_interval, format_number
from tumble.calibrations.core.view import Section
from tumble.messages import Message


def sections(result: AllanResult) -> Iterator[Section]:
    """How long to average, the coefficients, the curve, and the deviations one by one."""
    yield Section(
        title=Message("How long to average"),
        lines=(_dwell(result),),
        headings=(Message("Output"), Message("Least deviation"), Message("At"), Message("95% of such minima")),
        rows=[
            (name, format_number(each.best.deviation, each.unit), _seconds(each.best.tau_s), _interval(each.best))
            for name, each in result.outputs.items()
        ],
        brief=True,
    )
    yield Section(
        title=Message("Kinds of noise"),
        headings=(
            Message("Output"),
            Message("White noise N"),
            Message("Flicker B"),
            Message("Random walk K"),
        ),
        rows=[
            (name, *(_value(coefficient, each) for coefficient in each.model.coefficients))
            for name, each in result.outputs.items()
        ],
        brief=True,
    )
    yield Section(
        title=Message("Allan deviation"),
        figure=lambda: allan_figure(result),
        caption=Message(
            "Overlapping, with 95% intervals at averaging times that double; the line is N, B and K together."
        ),
    )
    for name, each in result.outputs.items():
        yield _one_by_one(name, each)


def _dwell(result: AllanResult) -> str:
    if result.dwell_s is None:
        return Message(
            "The noise falls as long as it can be averaged in this recording: a longer dwell is a better one."
        )
    return Message(
        "A dwell of {dwell} is within a tenth of the best for all outputs; longer ones gain little that this recording "
        "shows. Mean of the minima: {mean}.",
        dwell=_seconds(result.dwell_s),
        mean=_seconds(result.mean_best_s),
    )


def _seconds(tau_s: float) -> str:
    return format_number(tau_s, "s", 3)


def _interval(best: BestTime) -> str:
    if best.ends:
        return format_interval(best.low_s, best.high_s, "s")
    return Message("from {low}; a longer recording may put it later", low=_seconds(best.low_s))


def _value(coefficient: Coefficient, output: OutputNoise) -> str:
    unit = output.unit_of[coefficient.name]
    if coefficient.value is not None:
        return format_concise(coefficient.value, coefficient.standard_uncertainty, unit)
    assert coefficient.at_most is not None, "one of both is there"
    return Message("not told, at most {limit}", limit=format_number(coefficient.at_most, unit, 2))


def _one_by_one(name: str, output: OutputNoise) -> Section:
    return Section(
        title=Message("Allan deviation of {name}", name=name),
        headings=("τ", Message("Deviation"), Message("95% interval"), Message("Kind of noise")),
        rows=[
            (
                _seconds(each.tau_s),
                format_number(each.value, output.unit),
                format_interval(each.low, each.high, output.unit),
                each.noise,
            )
            for each in output.deviations
        ],
    )
