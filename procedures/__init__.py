"""Programmes, the engine that carries them out, and what is recorded of it.

A `Programme` is data; its `procedure()` is a generator of steps; the `Engine` carries them out at a stand, a `Sink`
keeps what happens and listeners show it. Recordings are in `tumble.procedures.recording`. What is here is loaded when
it is first asked for: who reads an error of a run need not wait for the engine.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from tumble.procedures.acquisition import Acquisition
    from tumble.procedures.announcer import Listener, Sink
    from tumble.procedures.control import Control
    from tumble.procedures.engine import Engine
    from tumble.procedures.errors import InputError, JournalError, ProgrammeError
    from tumble.procedures.operator import Answer, Answers, ConsoleOperator, Operator, ScriptedOperator, SeatingOperator
    from tumble.procedures.outcome import Outcome
    from tumble.procedures.plan import Plan, PlannedStep, plan
    from tumble.procedures.programme import Limit, Programme
    from tumble.procedures.programmes import load_programme, programme_from_text, shipped_programmes
    from tumble.procedures.progress import Progress, TimeLeft
    from tumble.procedures.toml_lines import line_of, load_toml, parse_toml

__all__ = [
    "Acquisition",
    "Answer",
    "Answers",
    "ConsoleOperator",
    "Control",
    "Engine",
    "InputError",
    "JournalError",
    "Limit",
    "Listener",
    "Operator",
    "Outcome",
    "Plan",
    "PlannedStep",
    "Programme",
    "ProgrammeError",
    "Progress",
    "ScriptedOperator",
    "SeatingOperator",
    "Sink",
    "TimeLeft",
    "line_of",
    "load_programme",
    "load_toml",
    "parse_toml",
    "plan",
    "programme_from_text",
    "shipped_programmes",
]

_HOMES: Final = {
    "Acquisition": "acquisition",
    "Answer": "operator",
    "Answers": "operator",
    "ConsoleOperator": "operator",
    "Control": "control",
    "Engine": "engine",
    "InputError": "errors",
    "JournalError": "errors",
    "Limit": "programme",
    "Listener": "announcer",
    "Operator": "operator",
    "Outcome": "outcome",
    "Plan": "plan",
    "PlannedStep": "plan",
    "Programme": "programme",
    "ProgrammeError": "errors",
    "Progress": "progress",
    "ScriptedOperator": "operator",
    "SeatingOperator": "operator",
    "Sink": "announcer",
    "TimeLeft": "progress",
    "line_of": "toml_lines",
    "load_programme": "programmes",
    "load_toml": "toml_lines",
    "parse_toml": "toml_lines",
    "plan": "plan",
    "programme_from_text": "programmes",
    "shipped_programmes": "programmes",
}
"""The module of each."""


def __getattr__(name: str) -> object:
    """Load what is asked for."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
