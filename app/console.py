"""What a person sees on the terminal: a progress bar while something runs, the result when it is there."""

import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any, Final

from rich.console import Console
from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn
from rich.table import Table
from rich.text import Text

from tumble.app.analysed import Analysed
from tumble.app.terminal import lead_nowhere, numeric, shown
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.quantities import (
    format_concise,
    format_freedom,
    format_interval,
)
from tumble.calibrations.core.verdict import Model, Outcome, Verdict
from tumble.drivers.clock import Clock
from tumble.messages import Message
from tumble.procedures.announcer import Listener
from tumble.procedures.events import (
    ConditionAnswered,
    ConditionRequested,
    Event,
    PointCompleted,
    ReadingAnswered,
    ReadingRequested,
    RetakeBegun,
    State,
    StateChanged,
    WarningRaised,
)
from tumble.procedures.plan import Plan
from tumble.procedures.progress import Progress as RunProgress
from tumble.procedures.steps import Point

_DECIDED = {
    Outcome.PASS: Message("inside limits"),
    Outcome.FAIL: Message("OUTSIDE LIMITS"),
    Outcome.NOT_DECIDED: Message("NOT DECIDED"),
}
_VERDICTS = {
    Outcome.PASS: Message("PASS"),
    Outcome.FAIL: Message("FAIL"),
    Outcome.NOT_DECIDED: Message("NOT DECIDED"),
}
_JUDGED = {Model.DECLARED: Message("the declared model"), Model.AUGMENTED: Message("the augmented model")}
_HEADINGS: Final = (
    Message("parameter"),
    Message("value (standard uncertainty)"),
    Message("95% interval"),
    Message("dof"),
    Message("remark"),
)
_PIPED_WIDTH = 120
"""Width of tables where the output is no terminal."""


class _Console(Console):
    """Text is text: nothing in it is markup or a sign by its name, and what cannot be seen is shown as an escape.

    Whoever reads may leave early: the rest goes nowhere, and the command ends as it would have.
    """

    def __init__(self, *, stderr: bool = False, width: int | None = None) -> None:
        super().__init__(stderr=stderr, width=width, markup=False, emoji=False, highlight=False)

    def render_str(self, text: str, **how: Any) -> Text:  # noqa: ANN401  # as rich has them
        """Everything that is printed comes through here, the cells and titles of tables too."""
        return super().render_str(shown(text), **how | {"markup": False, "emoji": False})

    def on_broken_pipe(self) -> None:
        """Say nothing more; rich itself would exit with status 1, which says that a unit is outside its limits."""
        self.quiet = True
        lead_nowhere(self.file)


def results() -> Console:
    """Where results go: standard output."""
    return _Console(width=None if sys.stdout.isatty() else _PIPED_WIDTH)


def messages() -> Console:
    """Where progress and warnings go: standard error, so that standard output stays clean for results."""
    return _Console(stderr=True)


def warn(sentences: Iterable[str]) -> None:
    """Print warnings on standard error."""
    for sentence in sentences:
        messages().print(_warning(sentence), markup=False, soft_wrap=True)


def _warning(sentence: str) -> Message:
    return Message("warning: {sentence}", sentence=sentence)


@contextmanager
def run_display(plan: Plan, clock: Clock, console: Console, points_done: int = 0) -> Iterator[Listener]:
    """A progress bar with the time left, on a terminal; yields the listener that feeds it.

    It is taken away while a question is open, lest it wipe what is being typed.
    """
    counted, told = RunProgress(plan, clock, points_done), _Telling()
    columns = (SpinnerColumn(), _text("{task.description}"), BarColumn(), _text("{task.fields[left]}"))
    with Progress(*columns, console=console, disable=not console.is_terminal) as bar:
        task = bar.add_task(shown(Message("measuring")), total=counted.total, left="")

        def listen(event: Event) -> None:
            counted(event)
            if isinstance(event, PointCompleted):
                left = counted.time_left()
                text = Message(
                    "{done}/{total}, {time_left} ± {standard_error} left",
                    done=counted.done,
                    total=counted.total,
                    time_left=_minutes(left.time_s),
                    standard_error=_minutes(left.standard_error_s),
                )
                bar.update(task, completed=counted.done, description=_place(event.point), left=shown(text))
            elif isinstance(event, ConditionRequested | ReadingRequested):
                _take_away(bar)
            elif isinstance(event, ConditionAnswered | ReadingAnswered):
                bar.start()
            elif sentence := told(event):
                bar.console.print(sentence, markup=False, soft_wrap=True)

        yield listen


class _Telling:
    """What is to be said of the events of a run."""

    def __init__(self) -> None:
        self._paused = False

    def __call__(self, event: Event) -> str:
        """A sentence; empty where there is nothing to be said."""
        match event:
            case WarningRaised(message=message):
                return _warning(message)
            case RetakeBegun(point=point):
                return Message("point {point} is taken again", point=point)
            case StateChanged(state=State.PAUSED):
                self._paused = True
                return Message("paused, and everything stands; continue has it go on")
            case StateChanged() if self._paused:
                self._paused = False
                return Message("the pause is over")
        return ""


def _place(point: Point) -> str:
    """Conditions and positions of a point, each in a column of its own."""
    return " ".join([*point.conditions.values(), *(f"{angle_deg:7.2f}°" for angle_deg in point.positions_deg.values())])


def _text(template: str) -> TextColumn:
    return TextColumn(template, markup=False)


def _take_away(bar: Progress) -> None:
    """Leave nothing of a bar on the terminal until it is started again."""
    if not bar.disable:
        bar.live.transient = True
        bar.stop()
        bar.live.transient = False


def _minutes(duration_s: float) -> str:
    """`1:02:03` or `2:03`."""
    seconds = round(duration_s)
    hours, rest = divmod(seconds, 3600)
    text = f"{rest // 60:02d}:{rest % 60:02d}"
    return f"{hours}:{text}" if hours else text


def show_result(analysed: Analysed, console: Console | None = None, *, verbose: bool = False) -> None:
    """Print verdict, the values to use, and how well they describe the rows.

    With `verbose` the rows, the noise and what the experiment supports are told one by one.
    """
    console = console or results()
    show_verdict(analysed.verdict, console)
    console.print(parameter_table(analysed))
    if analysed.model is Model.AUGMENTED:
        console.print(
            Message("values with what was found taken into account; the declared model's stand below"), markup=False
        )
    if record := analysed.measurement.stand_record:
        console.print(record.applied, markup=False)
    for line in analysed.details() if verbose else analysed.in_short():
        console.print(line, markup=False)


def show_verdict(verdict: Verdict, console: Console | None = None) -> None:
    """Print what is decided, of which model, and of every limited parameter why; nothing without limits."""
    if verdict.outcome is Outcome.NO_LIMITS:
        return
    console = console or results()
    outcome, model = _VERDICTS[verdict.outcome], _JUDGED[verdict.judged]
    console.print(Message("verdict: {outcome} (judged: {model})", outcome=outcome, model=model), markup=False)
    for judgement in verdict.parameters:
        console.print(Message("- {sentence}", sentence=judgement.sentence), markup=False, soft_wrap=True)


def parameter_table(analysed: Analysed) -> Table:
    """The values to use, each with its interval and what is to be said of it."""
    provenance = analysed.provenance
    table = Table(title=f"{provenance.serial_number} {provenance.programme_name}".strip(), title_justify="left")
    for heading in _HEADINGS:
        table.add_column(heading, overflow="fold", no_wrap=heading is not _HEADINGS[-1])
    verdict = analysed.verdict
    for name, parameter in analysed.parameters.items():
        judgement = verdict.of(name)
        decided = "" if judgement is None else _DECIDED[judgement.outcome]
        table.add_row(name, *_cells(parameter), Message.joined("; ", filter(None, (decided, _remark(parameter)))))
    return table


def _cells(parameter: Parameter) -> tuple[str, str, str]:
    if parameter.value is None:
        return Message("not identifiable"), "", ""
    return (
        numeric(format_concise(parameter.value, parameter.standard_uncertainty, parameter.unit)),
        "" if parameter.interval_95 is None else numeric(format_interval(*parameter.interval_95, parameter.unit)),
        format_freedom(parameter.degrees_of_freedom),
    )


def _remark(parameter: Parameter) -> str:
    return parameter.reason if parameter.value is None else parameter.condition
