"""What happens in a run as sentences in the language of the window.

What the engine says comes in English. A clause of it that `CLAUSES` knows is said in the language of the window, with
whatever stood in the braces; any other stays as it is, so that nothing is ever lost.
"""

import re
from functools import cache
from typing import Final

from PySide6.QtCore import QCoreApplication

from tumble.drivers.manual import format_dms
from tumble.procedures.events import (
    ConditionAnswered,
    ConditionRequested,
    Event,
    Identified,
    PointVerified,
    ReadingAnswered,
    RunFinished,
    RunResumed,
    State,
    StateChanged,
    WarningRaised,
)
from tumble.window.look.analysis_clauses import ANALYSIS_CLAUSES
from tumble.window.look.clauses import CLAUSES
from tumble.window.look.numbers import local

_BRACES: Final = "((?:(?!; ).)+?)"
"""Anything but the border of two clauses."""
translate: Final = QCoreApplication.translate


def sentence_of(event: Event) -> str:
    """What the log says of an event; empty where it says nothing."""
    match event:
        case Identified():
            text = translate("Sentences", "{instrument}: {model}, serial number {serial}, firmware {firmware}.")
            names = {"head": translate("Sentences", "Dividing head"), "daq": translate("Sentences", "Voltmeter")}
            said = text.format(
                instrument=names.get(event.instrument, event.instrument),
                model=event.model,
                serial=event.serial or "—",
                firmware=event.firmware or "—",
            )
        case ConditionRequested():
            said = translate("Sentences", "The unit is to be seated in the mount {mount}.").format(mount=event.value)
        case ConditionAnswered(confirmed=True):
            said = translate("Sentences", "The unit sits in the mount {mount}.").format(mount=event.value)
        case ReadingAnswered():
            text = translate("Sentences", "Set to {setting}; read: {answer}.")
            said = text.format(
                setting=format_dms(event.setting_deg), answer=event.answer or translate("Sentences", "as set")
            )
        case RunResumed():
            said = translate("Sentences", "The run goes on; {points} points are there already.").format(
                points=event.points
            )
        case PointVerified():
            text = translate("Sentences", "Point {point} was taken again: {now:.6f} V now, {before:.6f} V before.")
            said = text.format(point=event.point, now=event.now, before=event.recorded)
        case StateChanged(state=State.PAUSED | State.STANDSTILL):
            said = state_name(event.state) + "."
        case WarningRaised():
            said = in_language(event.message)
        case RunFinished():
            said = translate("Sentences", "The run is over: {message}.").format(message=in_language(event.message))
        case _:
            return ""
    return local(said)


def state_name(state: State) -> str:
    """Where a run stands, in a word or two."""
    return {
        State.IDLE: translate("Sentences", "Ready"),
        State.RUNNING: translate("Sentences", "Measuring"),
        State.PAUSED: translate("Sentences", "Paused; the head stands"),
        State.AWAITING_OPERATOR: translate("Sentences", "Waits for you"),
        State.STOPPING: translate("Sentences", "Stopping"),
        State.STANDSTILL: translate("Sentences", "The head stands"),
    }[state]


def in_language(text: str) -> str:
    """What was said in English, clause by clause in the language of the window, as far as that is known."""
    return local(_said(text))


def _said(text: str) -> str:
    for clause, end in ((text.removesuffix("."), "." * text.endswith(".")), (text, "")):
        if (whole := _clause(clause)) is not None:
            return whole + end
    for separator in (". ", "; "):
        if separator in text:
            return separator.join(map(_said, text.split(separator)))
    return text


def _clause(text: str) -> str | None:
    """A clause that is known; of several that fit, the one with the most words of its own."""
    fitting = [(template, found) for template, pattern in _patterns() if (found := pattern.fullmatch(text))]
    if not fitting:
        return None
    template, found = max(fitting, key=lambda fit: len(fit[0].replace("{}", "")))
    return translate("Clauses", template).format(*map(_said, found.groups()))


@cache
def _patterns() -> list[tuple[str, re.Pattern[str]]]:
    templates = (*CLAUSES, *ANALYSIS_CLAUSES)
    return [(template, re.compile(re.escape(template).replace(r"\{\}", _BRACES))) for template in templates]
