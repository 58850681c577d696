"""What is shown of a triad, the answer first."""

from collections.abc import Iterator
from dataclasses import replace

from tumble.calibrations.core.quantities import fixed, format_concise, format_number, join, two_digit_places
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.triad.correction import correction
from tumble.calibrations.methods.triad.loop import TriadLoop
from tumble.calibrations.methods.triad.over_temperature import temperature_section
from tumble.calibrations.methods.triad.picture_sections import picture_sections
from tumble.calibrations.report.budget_sections import budget_section, simulation_section
from tumble.calibrations.tracing.loop_sections import errors_section, parameters_section, traced_section, value_text
from tumble.calibrations.tracing.sentences import findings
from tumble.messages import Message


def sections(loop: TriadLoop) -> Iterator[Section]:
    """What is shown of a table of a triad."""
    return _composed(loop, parameters_section(loop))


def sections_beside_values(loop: TriadLoop) -> Iterator[Section]:
    """The same where the values to use are shown anyway: before and after, one by one, are details then."""
    return _composed(loop, replace(parameters_section(loop), brief=False))


def _composed(loop: TriadLoop, parameters: Section) -> Iterator[Section]:
    if loop.doubts:
        yield Section(title=Message("Please check the table"), lines=loop.doubts, brief=True)
        return
    yield traced_section(loop, findings(loop.effects))
    yield parameters
    yield errors_section(loop, Message("Held out are whole positions, with all their repeats."), "V")
    yield _scalar(loop)
    yield Section(title=Message("What to measure next"), lines=[each.why for each in loop.experiments], brief=True)
    yield temperature_section(loop.observations)
    yield from picture_sections(loop)
    stated = [parameter for parameter in loop.augmented.parameters.values() if parameter.value is not None]
    yield budget_section(stated, loop.augmented_budget.lines)
    yield simulation_section(stated, loop.augmented_budget.monte_carlo)
    yield _per_acceleration(loop)
    constants = correction(loop.best)
    yield Section(
        title=Message("Correction a = C (u - b)"),
        code=constants.as_c() + constants.as_python(),
    )


def _scalar(loop: TriadLoop) -> Section:
    if loop.scalar is None:
        return Section(title=Message("Scalar fit"))
    mismatch = loop.scalar.mismatch
    deviation = mismatch.standard_deviation_arcsec
    spread = Message(
        "Mismatch |a| - 1: mean {mean}, standard deviation {deviation}, degrees of freedom {freedom}, largest "
        "{largest}. It does not see a rotation of the unit against the stand, nor any error of the stand's angles.",
        mean=join(fixed(mismatch.mean_arcsec, two_digit_places(deviation)) if deviation else "—", "″"),
        deviation="—" if deviation is None else format_number(deviation, "″", 2),
        freedom=mismatch.degrees_of_freedom,
        largest=format_number(mismatch.largest_arcsec, "″", 2),
    )
    return Section(
        title=Message("Scalar fit"),
        lines=(spread,),
        headings=(Message("Parameter"), Message("Value")),
        rows=[(name, value_text(parameter)) for name, parameter in loop.scalar.parameters.items()],
    )


def _per_acceleration(loop: TriadLoop) -> Section:
    return Section(
        title=Message("Per m/s²"),
        headings=(Message("Parameter"), Message("Value")),
        rows=[
            (name, format_concise(each.value, each.standard_uncertainty, each.unit))
            for name, each in loop.augmented_budget.per_acceleration.items()
        ],
    )
