"""Programmes, the engine that carries them out, and what is recorded of it.

A `Programme` is data; its `procedure()` is a generator of steps; the `Engine` carries them out at a stand, a `Sink`
keeps what happens and listeners show it. Recordings are in `procedures.recording`.
"""

from procedures.acquisition import Acquisition
from procedures.announcer import Listener, Sink
from procedures.control import Control
from procedures.engine import Engine
from procedures.errors import InputError, JournalError, ProgrammeError
from procedures.operator import Answer, Answers, ConsoleOperator, Operator, ScriptedOperator, SeatingOperator
from procedures.outcome import Outcome
from procedures.plan import Plan, PlannedStep, check_limits, plan
from procedures.programme import Limit, Programme, load_programme, programme_from_text, shipped_programmes
from procedures.progress import Progress, TimeLeft
from procedures.toml_lines import line_of, load_toml, parse_toml

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
    "check_limits",
    "line_of",
    "load_programme",
    "load_toml",
    "parse_toml",
    "plan",
    "programme_from_text",
    "shipped_programmes",
]
