"""What happens in a run as sentences in the language of the window.

What the engine says comes in English. A clause of it that `CLAUSES` knows is said in the language of the window, with
whatever stood in the braces; any other stays as it is, so that nothing is ever lost.
"""

import re
from functools import cache

from PySide6.QtCore import QCoreApplication

from drivers.manual import format_dms
from procedures.events import (
    Event,
    Identified,
    MountAnswered,
    MountRequested,
    PointVerified,
    ReadingAnswered,
    RunFinished,
    RunResumed,
    State,
    StateChanged,
    WarningRaised,
)
from window.look.clauses import CLAUSES
from window.look.numbers import local


def tr(text: str) -> str:
    """A text of this module in the language of the window."""
    return QCoreApplication.translate("Sentences", text)


def sentence_of(event: Event) -> str:
    """What the log says of an event; empty where it says nothing."""
    match event:
        case Identified():
            text = tr("{instrument}: {model}, serial number {serial}, firmware {firmware}.")
            names = {"head": tr("Dividing head"), "daq": tr("Voltmeter")}
            said = text.format(
                instrument=names.get(event.instrument, event.instrument),
                model=event.model,
                serial=event.serial or "—",
                firmware=event.firmware or "—",
            )
        case MountRequested():
            said = tr("The unit is to be seated in the mount {mount}.").format(mount=event.mount)
        case MountAnswered(confirmed=True):
            said = tr("The unit sits in the mount {mount}.").format(mount=event.mount)
        case ReadingAnswered():
            text = tr("Set to {setting}; read: {answer}.")
            said = text.format(setting=format_dms(event.setting_deg), answer=event.answer or tr("as set"))
        case RunResumed():
            said = tr("The run goes on; {points} points are there already.").format(points=event.points)
        case PointVerified():
            text = tr("Point {point} was taken again: {now:.6f} V now, {before:.6f} V before.")
            said = text.format(point=event.point, now=event.voltage_v, before=event.recorded_v)
        case StateChanged(state=State.PAUSED | State.STANDSTILL):
            said = state_name(event.state) + "."
        case WarningRaised():
            said = in_language(event.message)
        case RunFinished():
            said = tr("The run is over: {message}.").format(message=in_language(event.message))
        case _:
            return ""
    return local(said)


def state_name(state: State) -> str:
    """Where a run stands, in a word or two."""
    return {
        State.IDLE: tr("Ready"),
        State.RUNNING: tr("Measuring"),
        State.PAUSED: tr("Paused; the head stands"),
        State.AWAITING_OPERATOR: tr("Waits for you"),
        State.STOPPING: tr("Stopping"),
        State.STANDSTILL: tr("The head stands"),
    }[state]


def in_language(sentence: str) -> str:
    """What was said in English, clause by clause in the language of the window, as far as that is known."""
    whole = _clause(sentence)
    return local(whole if whole is not None else "; ".join(_clause(part) or part for part in sentence.split("; ")))


def _clause(text: str) -> str | None:
    for template, pattern in _patterns():
        if found := pattern.fullmatch(text):
            return QCoreApplication.translate("Clauses", template).format(
                *(_clause(group) or group for group in found.groups())
            )
    return None


@cache
def _patterns() -> list[tuple[str, re.Pattern[str]]]:
    return [(template, re.compile(re.escape(template).replace(r"\{\}", "(.+?)"), re.DOTALL)) for template in CLAUSES]
