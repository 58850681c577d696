"""What was found in tables of a head or of parameters against temperature, on the terminal."""

from collections.abc import Sequence
from pathlib import Path

from rich.table import Table

from tumble.app.console import results, warn
from tumble.app.loop_console import findings_table
from tumble.calibrations.core.parameter import ModelFit, Parameter
from tumble.calibrations.core.quantities import format_concise, format_number
from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.core.sentences import series
from tumble.calibrations.methods.head_reference.changes import Comparison
from tumble.calibrations.methods.head_reference.loop import ReferenceLoop
from tumble.calibrations.methods.head_reference.sentences import (
    CHANGES_HEADINGS,
    PARTS_HEADINGS,
    SETTINGS_HEADINGS,
    change_rows,
    headline,
    most_telling,
    part_rows,
    sentences,
    setting_rows,
)
from tumble.calibrations.methods.temperature.loop import ParameterLoop, TemperatureLoop
from tumble.calibrations.methods.temperature.shared import shared_sentence
from tumble.calibrations.tracing.sentences import unexplained_sentence

_SETTINGS = 40
"""Of more angles than this those are shown that differ most."""
_LISTED = 6
"""Of the rows that are set aside so many are listed, the rest counted."""


def show_head(name: str, loop: ReferenceLoop) -> None:
    """Effects, the error before and after, how the passes differ, and what to measure next."""
    warn(loop.warnings)
    console = results()
    _set_aside(name, loop.observations.set_aside)
    console.print(f"{name}: {headline(loop)}", markup=False)
    if loop.question:
        return
    for unexplained in loop.unexplained:
        console.print(unexplained_sentence(unexplained), markup=False)
    if loop.effects:
        console.print(findings_table(loop.effects))
    if not loop.not_traced:
        console.print(_before_and_after(loop))
    if loop.by_setting:
        console.print(_settings(loop))
    for sentence in loop.limits:
        console.print(f"- {sentence}", markup=False)
    for experiment in loop.next_experiment:
        told = " from ".join((experiment.separates[0], series(experiment.separates[1:], "or")))
        console.print(f"next, to tell {told}: {experiment.why}", markup=False)


def _set_aside(name: str, aside: Sequence[SetAside]) -> None:
    if aside:
        listed = series([f"{entry.row} ({entry.reason})" for entry in aside[:_LISTED]])
        more = f" and {len(aside) - _LISTED} more" if len(aside) > _LISTED else ""
        results().print(f"{name}: set aside: rows {listed}{more}", markup=False)


def _before_and_after(loop: ReferenceLoop) -> Table:
    table = _table("Before and after", "", "constant offset", "with what was found")
    table.add_row("offset", *(_parameter(model) for model in (loop.declared, loop.augmented)))
    table.add_row("residual, r.m.s.", *(_deg(model.residual_rms) for model in (loop.declared, loop.augmented)))
    table.add_row("held-out error, r.m.s.", *(_deg(model.held_out_rms) for model in (loop.declared, loop.augmented)))
    if loop.passes:
        table.add_row("forward minus backward, r.m.s.", _deg(loop.passes.before_deg), _deg(loop.passes.after_deg))
    if any(loop.agreements):
        table.add_row("lack of fit against the repeats", *(each.words if each else "" for each in loop.agreements))
    return table


def _settings(loop: ReferenceLoop) -> Table:
    """The error of each angle as its repeats say it; of many angles those with the largest reversal error."""
    shown, left = most_telling(loop.by_setting, _SETTINGS)
    title = "Error by setting" + (f" (of {left + len(shown)} angles those that differ most)" if left else "")
    table = _table(title, *SETTINGS_HEADINGS)
    for row in setting_rows(shown):
        table.add_row(*row)
    return table


def show_comparison(comparison: Comparison, first: str, second: str) -> None:
    """How two tables of one head differ as maps, where, and what of it has a name."""
    console = results()
    for sentence in sentences(comparison, first, second):
        console.print(sentence, markup=False)
    if comparison.difference is None:
        return
    console.print(_parts(comparison, first, second))
    for unexplained in comparison.unexplained:
        console.print(f"In the difference: {unexplained_sentence(unexplained)}", markup=False)
    if comparison.changes:
        console.print(_changes(comparison))


def _parts(comparison: Comparison, first: str, second: str) -> Table:
    table = _table(f"{second} minus {first}", *PARTS_HEADINGS)
    for row in part_rows(comparison):
        table.add_row(*row)
    return table


def _changes(comparison: Comparison) -> Table:
    table = _table("What changed", *CHANGES_HEADINGS)
    for row in change_rows(comparison):
        table.add_row(*row)
    return table


def show_temperature(loop: TemperatureLoop) -> None:
    """Every parameter before and after, what several share, and what these runs cannot tell."""
    console = results()
    _set_aside(Path(loop.runs.source).name, loop.runs.set_aside)
    word = loop.parameters[0].polynomials[-1].words
    table = _table(
        f"Parameters against {loop.runs.temperature_name}: error of temperatures predicted from the others, r.m.s.",
        *("parameter", "constant", word, "with what was found", "traced to", f"{word} leaves (s)"),
    )
    for parameter in loop.parameters:
        table.add_row(parameter.name, *_errors(parameter), ", ".join(_effects(parameter)), _left(parameter))
    console.print(table)
    for cause in loop.shared:
        console.print(shared_sentence(cause), markup=False)
    for sentence in loop.unknowable:
        console.print(f"- {sentence}", markup=False)


def _errors(parameter: ParameterLoop) -> list[str]:
    errors = (parameter.polynomials[0], parameter.polynomials[-1], parameter.augmented)
    return [_number(error.held_out_rms, parameter.unit) for error in errors]


def _left(parameter: ParameterLoop) -> str:
    """Standard deviation of what the cubic leaves: what is usually printed."""
    return _number(parameter.polynomials[-1].standard_deviation, parameter.unit)


def _effects(parameter: ParameterLoop) -> list[str]:
    if parameter.explained.table.not_traced:
        return ["not looked for"]
    listed = []
    for effect in parameter.effects:
        at = effect.coefficients.get("at_degC")
        where = f" at {at.value:.1f} °C" if at else ""
        listed.append(f"{effect.name.removeprefix('temperature_')}{where}")
    return listed


def _parameter(model: ModelFit) -> str:
    stated: Parameter = next(iter(model.parameters.values()))
    if stated.value is None or stated.standard_uncertainty is None:
        return f"cannot be told: {stated.reason}"
    return format_concise(stated.value, stated.standard_uncertainty, stated.unit)


def _deg(value: float | None) -> str:
    return _number(value, "deg")


def _number(value: float | None, unit: str) -> str:
    return "none" if value is None else format_number(value, unit)


def _table(title: str, *headings: str) -> Table:
    table = Table(title=title, title_justify="left")
    for heading in headings:
        table.add_column(heading, overflow="fold")
    return table
