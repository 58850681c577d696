"""What was found in tables of a head or of parameters against temperature, on the terminal."""

from collections.abc import Sequence

from rich.table import Table

from app.console import results, warn
from app.loop_console import findings_table
from calibrations.quantities import format_concise, format_number
from calibrations.reference.changes import Change
from calibrations.reference.loop import ReferenceLoop
from calibrations.support import series
from calibrations.temperature.loop import ParameterLoop, TemperatureLoop
from calibrations.temperature.shared import shared_sentence
from calibrations.tracing.linear_loop import Model, Stated
from calibrations.tracing.words import unexplained_sentence

_LISTED = 6
"""Of the rows that are set aside so many are listed, the rest counted."""


def show_head(name: str, loop: ReferenceLoop) -> None:
    """Effects, the error before and after, how the passes differ, and what to measure next."""
    warn(loop.warnings)
    console = results()
    if aside := loop.observations.set_aside:
        listed = series([f"{entry.row} ({entry.reason})" for entry in aside[:_LISTED]])
        more = f" and {len(aside) - _LISTED} more" if len(aside) > _LISTED else ""
        console.print(f"{name}: set aside: rows {listed}{more}", markup=False)
    names = list(dict.fromkeys(effect.name for effect in loop.effects))
    found = f"was traced to {series(names)}" if names else "shows no effect"
    console.print(f"{name}: what the reference says beyond the head {found}.", markup=False)
    for unexplained in loop.unexplained:
        console.print(unexplained_sentence(unexplained), markup=False)
    if loop.effects:
        console.print(findings_table(loop.effects))
    console.print(_before_and_after(loop))
    for experiment in loop.next_experiment:
        told = " from ".join((experiment.separates[0], series(experiment.separates[1:], "or")))
        console.print(f"next, to tell {told}: {experiment.why}", markup=False)


def _before_and_after(loop: ReferenceLoop) -> Table:
    table = _table("Before and after", "", "constant offset", "with what was found")
    table.add_row("offset", *(_parameter(model) for model in (loop.declared, loop.augmented)))
    table.add_row("residual, r.m.s.", *(_deg(model.residual_rms) for model in (loop.declared, loop.augmented)))
    table.add_row("held-out error, r.m.s.", *(_deg(model.held_out_rms) for model in (loop.declared, loop.augmented)))
    if loop.passes:
        table.add_row("forward minus backward, r.m.s.", _deg(loop.passes.before_deg), _deg(loop.passes.after_deg))
    return table


def show_changes(listed: Sequence[Change]) -> None:
    """What is not the same in two tables of one head."""
    if not listed:
        results().print("Nothing changed beyond its uncertainty.")
        return
    table = _table("What changed", "effect", "before", "after", "difference", "its standard uncertainty")
    for change in listed:
        name = change.name if change.order is None else f"{change.name}, {change.order} per turn"
        sizes = [format_number(size, change.unit) if size else "none" for size in (change.before, change.after)]
        apart = (
            format_number(change.difference, change.unit),
            format_number(change.standard_uncertainty, change.unit, 2),
        )
        table.add_row(name, *sizes, *apart)
    results().print(table)


def show_temperature(loop: TemperatureLoop) -> None:
    """Every parameter before and after, what several share, and what these runs cannot tell."""
    console = results()
    table = _table(
        f"Parameters against {loop.runs.temperature_name}: error of runs predicted from the others, r.m.s.",
        *("parameter", "constant", "cubic", "with what was found", "traced to", "cubic leaves (s)"),
    )
    for parameter in loop.parameters:
        table.add_row(parameter.name, *_errors(parameter), ", ".join(_effects(parameter)), _left(parameter))
    console.print(table)
    for cause in loop.shared:
        console.print(shared_sentence(cause), markup=False)
    for sentence in loop.unknowable:
        console.print(f"- {sentence}", markup=False)


def _errors(parameter: ParameterLoop) -> list[str]:
    errors = (parameter.declared, parameter.polynomials[-1], parameter.augmented)
    return [_number(error.held_out_rms, parameter.unit) for error in errors]


def _left(parameter: ParameterLoop) -> str:
    """Standard deviation of what the cubic leaves: what is usually printed."""
    return _number(parameter.polynomials[-1].standard_deviation, parameter.unit)


def _effects(parameter: ParameterLoop) -> list[str]:
    listed = []
    for effect in parameter.effects:
        at = effect.coefficients.get("at_degC")
        where = f" at {at.value:.1f} °C" if at else ""
        listed.append(f"{effect.name.removeprefix('temperature_')}{where}")
    return listed


def _parameter(model: Model) -> str:
    stated: Stated = next(iter(model.parameters.values()))
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
