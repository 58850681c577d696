"""What is shown of a gyrocompass, the answer first."""

from collections.abc import Iterator
from dataclasses import replace

from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.gyrocompass.loop import GyrocompassLoop
from tumble.calibrations.methods.gyrocompass.misreading import MISREADING, misread_text
from tumble.calibrations.methods.gyrocompass.picture_sections import checks, if_as_declared, picture_sections
from tumble.calibrations.report.budget_sections import budget_section, simulation_section
from tumble.calibrations.tracing.loop_sections import errors_section, parameters_section, traced_section
from tumble.calibrations.tracing.sentences import Finding, findings
from tumble.messages import Message


def sections(loop: GyrocompassLoop) -> Iterator[Section]:
    """What is shown of a table of a gyrocompass."""
    return _composed(loop, parameters_section(loop))


def sections_beside_values(loop: GyrocompassLoop) -> Iterator[Section]:
    """The same where the values to use are shown anyway: before and after, one by one, are details then."""
    return _composed(loop, replace(parameters_section(loop), brief=False))


def _composed(loop: GyrocompassLoop, parameters: Section) -> Iterator[Section]:
    if loop.doubts:
        yield Section(title=Message("Please check the table"), lines=loop.doubts, brief=True)
        return
    yield traced_section(loop, _found(loop), loop.not_traced)
    yield parameters
    yield errors_section(
        loop,
        Message("Held out are the rates of whole realisations, or of dwells dealt out where these are few."),
        "°/h",
    )
    yield if_as_declared(loop)
    yield checks(loop)
    yield Section(title=Message("What to measure next"), lines=[each.why for each in loop.experiments], brief=True)
    yield from picture_sections(loop)
    stated = [parameter for parameter in loop.augmented.parameters.values() if parameter.value is not None]
    yield budget_section(stated, loop.augmented_budget.lines)
    yield simulation_section(stated, loop.augmented_budget.monte_carlo)


def _found(loop: GyrocompassLoop) -> list[Finding]:
    text = misread_text(loop.misread)
    return [replace(each, coefficients=text) if each.name == MISREADING else each for each in findings(loop.effects)]
