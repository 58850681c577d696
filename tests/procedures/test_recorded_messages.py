"""A message that was recorded comes back as a message, and what is no message as the text that it is."""

import math
from pathlib import Path

import pytest

from tumble.drivers.errors import CHECK_CABLE, NO_ANSWER, DeviceError
from tumble.messages import Language, Message
from tumble.procedures.events import FinishReason, RunFinished, WarningRaised
from tumble.procedures.methods.dividing_head.layout import LAYOUT
from tumble.procedures.recording.messages import encode, from_message, to_messages
from tumble.procedures.recording.said import message_of, said_of


def recorded(event):
    ((topic, values),) = to_messages(event, LAYOUT)
    return from_message(topic, encode(values), LAYOUT)


@pytest.mark.parametrize(
    "message",
    [
        Message("does not answer"),
        Message("{angle_deg:g} deg", angle_deg=12.5),
        Message("{path} holds no end of the run; {kept}", path=Path("a.mcap"), kept=Message("(none)")),
        Message.counted("{count} row", "{count} rows", count=2),
        Message("was answered {answer!r}", answer="no"),
        str(DeviceError(Message("dividing head"), NO_ANSWER, CHECK_CABLE)),
    ],
)
def test_a_message_comes_back_from_a_recording(message):
    came = recorded(WarningRaised(message=message)).message
    assert came == message
    assert [came.in_language(language) for language in Language] == [message.in_language(lang) for lang in Language]


def test_the_reason_of_an_end_is_told_in_the_language_of_its_reader():
    reason = Message("the operator stopped the run")
    came = recorded(RunFinished(reason=FinishReason.STOPPED, message=reason, at_standstill=True))
    assert came.message.in_language(Language.GERMAN) == "der Bediener hat den Lauf angehalten"


def test_plain_text_stays_plain_text():
    came = recorded(WarningRaised(message="the certificate of the DAQ has expired")).message
    assert came == "the certificate of the DAQ has expired"
    assert not isinstance(came, Message)


def test_what_cannot_be_written_as_json_leaves_the_text():
    assert not isinstance(recorded(WarningRaised(message=Message("{v:.3f} V", v=math.nan))).message, Message)


@pytest.mark.parametrize(
    "said",
    [
        None,
        3,
        {},
        {"template": "does not answer", "plural": "", "fields": None},
        {"template": "{v:>999999999999}", "plural": "", "fields": {"v": "x"}},
        {"template": "{v.__class__}", "plural": "", "fields": {"v": "x"}},
        {"template": "{v}", "plural": "", "fields": {}},
        {"template": "something else", "plural": "", "fields": {}},
        {"template": "{count}", "plural": "{count}s", "fields": {"count": "many"}},
        {"template": 7, "plural": "", "fields": {}},
    ],
)
def test_what_was_altered_leaves_the_text(said):
    assert message_of("does not answer", said) == "does not answer"
    assert not isinstance(message_of("does not answer", said), Message)


def test_no_other_text_has_a_template():
    assert said_of("does not answer") is None
