"""Runs of `tumble` inside the tests' own process, and the small files that they are given."""

import io
import sys
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from unittest.mock import patch

from app.cli import main

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
    return Ran(status=status, out=out.getvalue(), err=err.getvalue())


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
