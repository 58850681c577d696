"""What happens in a run as sentences in the language of the window."""

from tumble.drivers.manual import format_dms
from tumble.messages import Message, translate
from tumble.numerals import localised
from tumble.procedures.events import (
    ConditionAnswered,
    ConditionRequested,
    Event,
    Identified,
    PointVerified,
    ReadingAnswered,
    RetakeBegun,
    RunFinished,
    RunResumed,
    State,
    StateChanged,
    WarningRaised,
)
from tumble.procedures.plan import Plan
from tumble.window.look.conditions import ConditionWords
from tumble.window.look.language import spoken, tr
from tumble.window.look.names import instrument_name
from tumble.window.look.numbers import local, minutes


def sentence_of(event: Event, words: ConditionWords) -> str:
    """What the log says of an event, in a method's `words` for what the operator sets; empty where it says nothing."""
    match event:
        case Identified():
            said = tr(
                "{instrument}: {model}, serial number {serial}, firmware {firmware}.",
                instrument=instrument_name(event.instrument),
                model=event.model,
                serial=event.serial or "—",
                firmware=event.firmware or "—",
            )
        case ConditionRequested():
            said = words.requested(event.condition, event.value)
        case ConditionAnswered(confirmed=True):
            said = words.confirmed(event.condition, event.value)
        case ReadingAnswered():
            answer = event.answer or tr("as set")
            said = tr("Set to {setting}; read: {answer}.", setting=format_dms(event.setting_deg), answer=answer)
        case RunResumed():
            said = in_language(
                Message.counted(
                    "The run goes on; {count} point is there already.",
                    "The run goes on; {count} points are there already.",
                    count=event.points,
                )
            )
        case RetakeBegun() | PointVerified():
            said = _taken_again(event)
        case StateChanged(state=State.PAUSED | State.STANDSTILL):
            said = state_name(event.state) + "."
        case WarningRaised():
            said = in_language(event.message)
        case RunFinished():
            said = tr("The run is over: {message}.", message=in_language(event.message))
        case _:
            return ""
    return local(said)


def _taken_again(event: RetakeBegun | PointVerified) -> str:
    """That it is, or what came of it: in volts where the name of the channel ends in these."""
    if isinstance(event, RetakeBegun):
        return tr("Point {point} is taken again.", point=event.point)
    if not event.channel.endswith("_v"):
        return tr(
            "Point {point} was taken again: {channel} {now:.7g} now, {before:.7g} before.",
            point=event.point,
            channel=event.channel,
            now=event.now,
            before=event.recorded,
        )
    return tr(
        "Point {point} was taken again: {now:.6f} V now, {before:.6f} V before.",
        point=event.point,
        now=event.now,
        before=event.recorded,
    )


def state_name(state: State) -> str:
    """Where a run stands, in a word or two."""
    return {
        State.IDLE: tr("Ready"),
        State.RUNNING: tr("Measuring"),
        State.PAUSED: tr("Paused at a standstill"),
        State.AWAITING_OPERATOR: tr("Waits for you"),
        State.STOPPING: tr("Stopping"),
        State.STANDSTILL: tr("At a standstill"),
    }[state]


def plan_text(plan: Plan) -> str:
    """What a programme takes: points, mountings where there are any, time."""
    mountings = Message.counted("{count} mounting", "{count} mountings", count=plan.requests)
    parts = (
        Message.counted("{count} point", "{count} points", count=plan.dwells),
        *((mountings,) if plan.requests else ()),
        Message("about {time}", time=minutes(plan.duration_s)),
    )
    return in_language(Message.joined(", ", parts))


def lot_text(lot: str) -> str:
    """The lot of a unit; empty where there is none."""
    return tr("lot {lot}", lot=lot) if lot else ""


def held_text() -> str:
    """Of a queue that waits until somebody goes on with it."""
    return tr("The queue is held; F4 goes on with it.")


def unit_text(serial_number: str, lot: str) -> str:
    """A unit by what a person can read on it, to be held against that."""
    return " · ".join(filter(None, (serial_number, lot_text(lot))))


def stopped_text(points: int) -> str:
    """What is left of a run that the person stopped after so many points, and what there is to do with it."""
    return in_language(
        Message.counted(
            "Stopped; {count} complete point is kept. F7 goes on, or it is analysed as it is.",
            "Stopped; {count} complete points are kept. F7 goes on, or they are analysed as they are.",
            count=points,
        )
    )


def in_language(text: str) -> str:
    """A message, or a text that is a key of the catalogue, in the language of the window; any other as it is.

    What documents call by a name is called in words.
    """
    if isinstance(text, Message):
        return localised(text.worded(spoken()), spoken(), text.as_written())
    return local(translate(text, spoken()))
