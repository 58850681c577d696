from dataclasses import fields, replace
from datetime import date
from pathlib import Path

import hypothesis.strategies as st
import numpy as np
import orjson
import pytest
from hypothesis import given
from recording_examples import FINISHED, HEADER, POINT, ROW, completed, record, run_of, samples

from tumble.drivers.protocols import ChannelBlock
from tumble.procedures.events import (
    ConditionAnswered,
    ConditionRequested,
    FinishReason,
    PointCompleted,
    RunFinished,
    SamplesAcquired,
    State,
    StateChanged,
    StepStarted,
    WarningRaised,
)
from tumble.procedures.methods.dividing_head.layout import LAYOUT, MOUNT, dwell_at, mounting
from tumble.procedures.methods.dividing_head.rows import Row, row_of
from tumble.procedures.recording.blocks import join, split
from tumble.procedures.recording.contents import Said, contents
from tumble.procedures.recording.header import Header, header_from_strings, header_to_strings
from tumble.procedures.recording.messages import encode, from_message, to_messages
from tumble.procedures.recording.reader import iter_samples, read_recording
from tumble.procedures.recording.schemas import json_schema, topics


def through_json(event):
    topic, values = list(to_messages(event, LAYOUT))[-1]
    return from_message(topic, encode(values), LAYOUT)


def test_everything_a_run_announces_comes_back(tmp_path):
    recording = read_recording(record(tmp_path / "run.mcap", run_of(3)))

    assert recording.header == HEADER
    assert recording.points == tuple(replace(POINT, index=index) for index in range(3))
    dwell = dwell_at(angle_deg=35.0, procedure="sweep", realisation=1, mount="face-up")
    assert recording.steps == (mounting("face-up"), dwell, dwell, dwell)
    assert recording.answers == (
        ConditionAnswered(condition=MOUNT, value="face-up", answer="так, сидить", confirmed=True),
    )
    assert recording.events == (
        StateChanged(state=State.RUNNING),
        ConditionRequested(condition=MOUNT, value="face-up", prompt="Seat the unit face-up"),
        WarningRaised(message="the certificate of the DAQ has expired"),
        FINISHED,
    )


def test_a_recording_without_any_event_has_a_header_and_no_end(tmp_path):
    recording = read_recording(record(tmp_path / "run.mcap", []))

    assert recording.header == HEADER
    assert recording.points == ()
    assert recording.closed
    assert not recording.finished
    assert not recording.complete


def test_only_a_closed_file_of_a_completed_run_is_complete(tmp_path):
    stopped = RunFinished(reason=FinishReason.STOPPED, message="stopped at point 1", at_standstill=True)

    complete = read_recording(record(tmp_path / "complete.mcap", [completed(0), FINISHED]))
    early = read_recording(record(tmp_path / "early.mcap", [completed(0), stopped]))

    assert complete.complete
    assert early.finished
    assert early.ending == stopped
    assert not early.complete


def test_a_point_recorded_twice_is_read_once_and_as_it_was_first(tmp_path):
    events = [completed(1), completed(0), completed(1, voltage_v=9.0)]

    points = read_recording(record(tmp_path / "run.mcap", events)).points

    assert points == (POINT, replace(POINT, index=1))


doubles = st.floats(allow_nan=True, allow_infinity=True, width=64)


@given(voltage_v=doubles, temperature_degc=st.none() | doubles, angle_deg=doubles)
def test_a_point_comes_back_with_every_bit_of_its_numbers(voltage_v, temperature_degc, angle_deg):
    row = replace(ROW, voltage_v=voltage_v, temperature_degc=temperature_degc, angle_deg=angle_deg)

    again = row_of(through_json(PointCompleted(point=row.point)))

    assert again.settled is True
    assert (again.temperature_degc is None) == (temperature_degc is None)
    for name in ("voltage_v", "angle_deg", "temperature_degc"):
        before, after = getattr(row, name), getattr(again, name)
        if before is not None:
            np.testing.assert_array_equal(after, before)
            assert np.signbit(after) == np.signbit(before) or np.isnan(before)


@given(answer=st.text())
def test_an_answer_comes_back_word_for_word(answer):
    event = ConditionAnswered(condition=MOUNT, value="edge", answer=answer, confirmed=False)

    assert through_json(event) == event


def test_an_answer_that_is_no_text_is_kept_legible():
    event = ConditionAnswered(condition=MOUNT, value="edge", answer="ok \udcff", confirmed=True)

    assert through_json(event).answer == "ok \\udcff"


@pytest.mark.parametrize(
    ("value", "text"), [(np.nan, b'"NaN"'), (np.inf, b'"Infinity"'), (-np.inf, b'"-Infinity"'), (9.9e37, b"9.9e+37")]
)
def test_numbers_that_json_lacks_are_strings(value, text):
    assert encode({"x": value}) == b'{"x":' + text + b"}"
    assert encode({"x": np.array([1.0, value])}) == b'{"x":[1.0,' + text + b"]}"


@given(
    voltage_v=st.lists(doubles, max_size=40) | st.integers(999, 3001).map(lambda n: [k / 7 for k in range(n)]),
    channels=st.integers(1, 3),
    temperature_degc=st.none() | st.floats(-60, 60),
)
def test_a_block_comes_back_from_its_messages(voltage_v, channels, temperature_degc):
    rows = np.array([np.roll(voltage_v, channel) for channel in range(channels)])
    names = ["u_x_v", "u_y_v", "rate_deg_h"] if channels > 1 else ["voltage_v"]
    block = ChannelBlock(
        channels=dict(zip(names, rows, strict=False)),
        rate_hz=1000.0,
        device_time_s=0.1,
        temperature_degc=temperature_degc,
    )
    event = SamplesAcquired(point=7, time_s=1.5, block=block)

    (again,) = join(orjson.loads(encode(part)) for part in split(event))

    assert list(again.block.channels) == list(block.channels)
    for name, values in block.channels.items():
        np.testing.assert_array_equal(again.block.channels[name], values)
    assert (again.point, again.time_s, again.block.rate_hz) == (7, 1.5, 1000.0)
    assert (again.block.device_time_s, again.block.temperature_degc) == (0.1, temperature_degc)


def test_a_block_is_split_into_messages_of_a_thousand_samples():
    parts = list(split(samples(0, range(2500))))

    assert [(part["first_sample"], len(part["voltage_v"])) for part in parts] == [(0, 1000), (1000, 1000), (2000, 500)]


def test_a_block_whose_last_message_is_missing_is_left_out():
    *begun, _ = split(samples(0, range(2500)))

    assert [event.point for event in join([*begun, *split(samples(1))])] == [1]


def test_samples_are_read_block_by_block(tmp_path):
    path = record(tmp_path / "run.mcap", run_of(3))

    blocks = list(iter_samples(path))

    assert [event.point for event in blocks] == [0, 1, 2]
    np.testing.assert_array_equal(blocks[2].block.voltage_v, [2.5, 2.50001, 9.9e37])


def test_every_message_holds_fields_of_its_schema_and_no_others(tmp_path):
    path = record(tmp_path / "run.mcap", run_of(2))

    said = [entry for entry in contents(path, topics(LAYOUT)) if isinstance(entry, Said)]

    assert {entry.topic for entry in said} == set(topics(LAYOUT))
    for entry in said:
        properties = orjson.loads(json_schema(entry.topic, LAYOUT))["properties"]
        assert set(orjson.loads(entry.data)) <= set(properties)


def test_the_schema_of_a_point_has_every_field_of_a_point():
    assert set(topics(LAYOUT)["/point"]) == {field.name for field in fields(Row)}


def test_no_schema_has_a_list_of_types():
    for topic in topics(LAYOUT):
        schema = orjson.loads(json_schema(topic, LAYOUT))
        assert all(isinstance(described["type"], str) for described in schema["properties"].values())


def test_a_point_without_temperature_has_no_temperature_message():
    topics = [topic for topic, _ in to_messages(completed(0, temperature_degc=None), LAYOUT)]

    assert topics == ["/head", "/point"]


def test_the_row_of_a_point_comes_after_what_repeats_it():
    assert [topic for topic, _ in to_messages(completed(0), LAYOUT)] == ["/head", "/temperature", "/point"]


def test_a_step_says_which_kind_it_is():
    ((topic, values),) = to_messages(StepStarted(step=mounting("end")), LAYOUT)

    assert (topic, values) == ("/step", {"kind": "mounting", "mount": "end"})


def test_a_header_refuses_the_simulated_table():
    with pytest.raises(ValueError, match=r"\[simulated\]"):
        replace(HEADER, stand={"name": "bench-1", "simulated": {"seed": 1}})


def test_a_header_survives_as_strings():
    strings = header_to_strings(HEADER)

    assert all(isinstance(value, str) for value in strings.values())
    assert "programme_text" not in strings
    assert header_from_strings(strings, HEADER.programme_text) == HEADER


def test_dates_of_a_stand_file_become_iso_strings():
    header: Header = replace(HEADER, stand={"head": {"calibration_due": date(2027, 3, 1)}})

    again = header_from_strings(header_to_strings(header), "")

    assert again.stand == {"head": {"calibration_due": "2027-03-01"}}


def test_a_recording_of_the_first_format_is_still_read():
    recording = read_recording(Path(__file__).parent / "fixtures" / "recording_v1.mcap")
    assert (recording.header.format_version, recording.header.job) == (1, "run")
    assert recording.complete
    assert [point.positions_deg["head"] for point in recording.points] == [0.0, 60.0, 120.0, 180.0, 240.0, 300.0]


def test_a_header_that_names_no_method_is_of_the_dividing_head():
    strings = header_to_strings(HEADER)
    written = {name: text for name, text in strings.items() if name not in ("method", "method_version")}

    header = header_from_strings(written, HEADER.programme_text)

    assert (header.method, header.method_version) == ("dividing_head", 1)
