"""Runs of `tumble` inside the tests' own process, and the small files that they are given."""

import io
import pickle
import sys
from contextlib import ExitStack, contextmanager, redirect_stderr, redirect_stdout
from dataclasses import dataclass, replace
from unittest.mock import patch

from markupsafe import Markup

from tumble.app.cli import main
from tumble.app.terminal import speak
from tumble.calibrations.methods.dividing_head import analysis
from tumble.calibrations.methods.dividing_head.loop.loop import explain_questioned
from tumble.messages import Language
from tumble.procedures.control import Control
from tumble.procedures.events import PointCompleted
from tumble.procedures.recording.writer import Recorder

STAND = """\
name = "bench-1"

[site]
latitude_deg = 50.45

[head]
driver = "simulated"
limits_deg = [-180.0, 760.0]

[daq]
driver = "simulated"

[simulated]
preset = "DXL203EB"
"""

TINY = """\
name = "tiny"
dwell_s = 0.1
settle_s = 0.0

[[procedure]]
kind = "sweep"
step_deg = 60.0
points = 6
"""
"""Six dwells in one mount."""


@dataclass(frozen=True, kw_only=True)
class Ran:
    """What a run of `tumble` left."""

    status: int
    out: str
    err: str

    @property
    def complaint(self):
        """The only line on standard error, without the name of the program."""
        (line,) = self.err.splitlines()
        assert line.startswith("tumble: ")
        return line.removeprefix("tumble: ")


def tumble(*arguments):
    """Call `tumble` as a shell would."""
    out, err = io.StringIO(), io.StringIO()
    status = 0
    with (
        patch.object(sys, "argv", ["tumble", *map(str, arguments)]),
        redirect_stdout(out),
        redirect_stderr(err),
    ):
        try:
            main()
        except SystemExit as leaving:
            status = leaving.code
        finally:
            speak(Language.ENGLISH)  # a shell begins each time anew
    return Ran(status=status, out=out.getvalue(), err=err.getvalue())


def few_trials_of(simulate):
    """Monte Carlo with a hundred trials: it takes most of the time of a fit."""
    return lambda *arguments: simulate(*arguments[:-1], 100)


@contextmanager
def cheaply(blank="report"):
    """A blank report, or one with blank "figures", and few trials: for fixtures of tests that look at other things."""
    with ExitStack() as stack:
        stack.enter_context(patch.object(analysis, "monte_carlo", few_trials_of(analysis.monte_carlo)))
        if blank == "report":
            stack.enter_context(patch("tumble.calibrations.report.page.html", lambda _: "<html></html>"))
        else:
            stack.enter_context(blank_figures())
        yield


@contextmanager
def blank_figures():
    """Figures are made, but not drawn, which takes most of the time of a report."""
    with patch("tumble.calibrations.report.figure.drawn", lambda _: Markup("<svg></svg>")):
        yield


_traced = {}


def _explain_once(asked, stand, reference_temperature_degc, *effects):
    if effects:  # they hold functions, of which none knows whether they are equal
        return explain_questioned(asked, stand, reference_temperature_degc, *effects)
    rows = pickle.dumps((replace(asked.observations, source=""), stand, reference_temperature_degc))
    if rows not in _traced:
        _traced[rows] = explain_questioned(asked, stand, reference_temperature_degc)
    return _traced[rows]


@contextmanager
def tracing_once():
    """The same rows of the same stand are traced once, from whatever file they come."""
    with patch("tumble.app.methods.dividing_head.job.explain_questioned", _explain_once):
        yield


def at_call(monkeypatch, owner, name, first, happen, last=None):
    """Have `happen` called before the calls of `owner.name` from number `first` to `last`, counted from 1."""
    original = getattr(owner, name)
    calls = 0

    def replacement(*arguments, **named):
        nonlocal calls
        calls += 1
        if first <= calls and (last is None or calls <= last):
            happen()
        return original(*arguments, **named)

    monkeypatch.setattr(owner, name, replacement)


def raiser(error):
    """Return a function that raises `error`, whatever it is called with."""

    def fail(*_arguments, **_named):
        raise error

    return fail


def take_again_once(monkeypatch, index):
    """Have a point of a run taken again as soon as it is there, as somebody at the window would."""
    wishes, record, heed = [], Recorder.record, Control.heed_again

    def record_and_wish(recorder, event):
        remark = record(recorder, event)
        if isinstance(event, PointCompleted) and (event.point.index, event.point.take) == (index, 1):
            wishes.append(index)
        return remark

    monkeypatch.setattr(Recorder, "record", record_and_wish)
    monkeypatch.setattr(Control, "heed_again", lambda control: wishes.pop() if wishes else heed(control))
