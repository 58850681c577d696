"""Programmes, the engine that carries them out, and what is recorded of it.

A `Programme` is data; its `procedure()` is a generator of steps; the `Engine` carries them out at a stand, a `Sink`
keeps what happens and listeners show it. Recordings are in `tumble.procedures.recording`.
"""

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
