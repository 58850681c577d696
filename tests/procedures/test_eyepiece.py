import math
from dataclasses import replace

import pytest
from fakes import QUICK, FakeDaq, FakeHead, MemorySink, point_at

from tumble.drivers.clock import VirtualClock
from tumble.drivers.manual import ManualHead
from tumble.drivers.manual.reading import on_the_circle
from tumble.drivers.protocols import Stand
from tumble.procedures.engine import Engine
from tumble.procedures.events import FinishReason, PointCompleted, ReadingAnswered, ReadingRequested
from tumble.procedures.eyepiece import OperatorEyepiece
from tumble.procedures.methods.dividing_head.contradiction import contradiction
from tumble.procedures.methods.dividing_head.doubt import doubt
from tumble.procedures.methods.dividing_head.layout import dwell_at
from tumble.procedures.methods.dividing_head.rows import row_of
from tumble.procedures.operator import Answers, ScriptedOperator
from tumble.procedures.programmes import programme_from_text
from tumble.procedures.second_look import ReadAgain

SWEEP = programme_from_text('name = "a"\n[[procedure]]\nkind = "sweep"\nstep_deg = 30\npoints = 12\n', "a.toml")


class HandTurned:
    """A person who always sets the head right; what is typed comes from the answers."""

    def __init__(self, eyepiece, head):
        self.eyepiece, self.head = eyepiece, head

    def show(self, setting_deg):
        self.head.start_move(setting_deg)
        self.eyepiece.show(setting_deg)

    def reading_deg(self):
        return None if self.head.status().moving else self.eyepiece.reading_deg()

    def withdraw(self):
        self.eyepiece.withdraw()


def run(readings, programme=SWEEP, journal=None, hear=lambda _control, _event: None):
    """Run with what is typed at each question, Enter alone by default; return the outcome and the events."""
    clock = VirtualClock()
    fake = FakeHead(clock)
    daq = FakeDaq(clock, fake)
    daq.mount = "face-up"
    operator = ScriptedOperator(Answers(mounts={"default": "yes"}, readings=readings))
    eyepiece = OperatorEyepiece(operator, clock, 60 / 3600)
    head = ManualHead(HandTurned(eyepiece, fake), clock, limits_deg=(-180.0, 760.0), speed_deg_s=5.0)
    sink = MemorySink()
    engine = Engine(
        Stand(name="bench", positioners={"head": head}, samplers={"daq": daq}, clock=clock),
        operator,
        sink,
        QUICK,
        (lambda event: hear(engine.control, event),),
        ReadAgain({"head": eyepiece}, contradiction),
    )
    if journal is None:
        return engine.run(programme.procedure), sink
    return engine.resume(programme.procedure, journal), sink


def asked(sink):
    return [event.prompt for event in sink.of(ReadingRequested)]


def test_enter_alone_takes_a_point_at_every_setting():
    outcome, sink = run({"default": ""})
    assert outcome.reason is FinishReason.COMPLETED
    assert [point.positions_deg["head"] for point in outcome.points] == [30.0 * number for number in range(12)]
    assert len(sink.of(ReadingAnswered)) == 12
    assert asked(sink)[1] == "Set the head to 30° 00′ 00″; Enter when it reads so, or type the reading."


def test_a_reading_is_taken_in_place_of_the_setting():
    outcome, sink = run({"default": "", "2": "30 00 12"})
    assert outcome.points[1].positions_deg["head"] == pytest.approx(30.0 + 12 / 3600)
    assert sink.of(ReadingAnswered)[1] == ReadingAnswered(
        setting_deg=30.0, answer="30 00 12", reading_deg=pytest.approx(30.0 + 12 / 3600)
    )


def test_a_reading_far_from_the_setting_is_asked_for_again_and_kept_when_typed_twice():
    outcome, sink = run({"default": "", "2": "25 00", "3": "25:00:00"})
    assert asked(sink)[2] == (
        "You read 25° 00′ 00″, the setting was 30° 00′ 00″: type it again to keep it, or set the head right and press "
        "Enter."
    )
    assert outcome.points[1].positions_deg["head"] == 25.0


def test_a_slip_of_the_finger_is_corrected_with_enter():
    outcome, _ = run({"default": "", "2": "25 00", "3": ""})
    assert outcome.points[1].positions_deg["head"] == 30.0


def test_an_answer_that_is_never_an_angle_is_none():
    outcome, sink = run({"default": "", **{str(question): "abc" for question in range(2, 30)}})
    assert outcome.reason is FinishReason.UNANSWERED
    assert outcome.message.startswith(
        "the request to set the head to 30° 00′ 00″ was answered 10 times in a row with no angle: 'abc' is no angle"
    )
    assert len(sink.of(ReadingAnswered)) == 11


def test_what_is_no_angle_is_asked_for_again_and_journaled():
    outcome, sink = run({"default": "", "2": "abc", "3": "30,001"})
    assert outcome.points[1].positions_deg["head"] == pytest.approx(30.001)
    assert [event.answer for event in sink.of(ReadingAnswered)][1:3] == ["abc", "30,001"]
    assert math.isnan(sink.of(ReadingAnswered)[1].reading_deg)
    assert "'abc' is no angle" in asked(sink)[2]


@pytest.mark.parametrize(("typed", "said"), [("no", "was answered 'no'"), (None, "was not answered")])
def test_who_declines_or_is_not_there_ends_the_run_with_its_points(typed, said):
    readings = {"1": "", "2": ""} if typed is None else {"default": "", "3": typed}
    outcome, _ = run(readings)
    assert (outcome.reason, len(outcome.points)) == (FinishReason.UNANSWERED, 2)
    assert outcome.message == f"the request to set the head to 60° 00′ 00″ {said}; set it and resume the run"


def test_a_second_turn_is_read_on_the_circle_and_counted_on():
    far = programme_from_text(SWEEP.text.replace("step_deg = 30", "start_deg = 390\nstep_deg = 5"), "a.toml")
    outcome, sink = run({"default": "", "1": "30 00 06"}, far)
    assert asked(sink)[0].startswith("Set the head to 30° 00′ 00″;")
    assert outcome.points[0].positions_deg["head"] == pytest.approx(390.0 + 6 / 3600)


def test_a_voltage_that_contradicts_the_reading_is_questioned_with_a_guess():
    # The head stands at 330°, the person types 320°, twice; the voltage knows better.
    outcome, sink = run({"default": "", "12": "320", "13": "320", "14": "330"})
    question = asked(sink)[-1]
    assert "V off at 320° 00′ 00″ and would fit 330° 00′ 00″: a wrong degree?" in question
    assert outcome.points[11].positions_deg["head"] == 330.0
    assert [event.point.positions_deg["head"] for event in sink.of(PointCompleted)][11] == 330.0


def test_who_insists_keeps_the_reading():
    outcome, sink = run({"default": "", "12": "320", "13": "320", "14": ""})
    assert outcome.points[11].positions_deg["head"] == 320.0
    assert len(asked(sink)) == 14


def test_a_run_with_a_kept_reading_can_be_resumed():
    begun, _ = run({"default": "", "2": "25 00", "3": "25:00:00"})
    outcome, _ = run({"default": ""}, journal=begun.points[:5])
    assert outcome.reason is FinishReason.COMPLETED
    assert outcome.points[1].positions_deg["head"] == 25.0


def points_at(angles_deg, noise_v=1e-4):
    return [
        replace(
            row_of(
                point_at(
                    dwell_at(angle_deg=angle_deg, procedure="sweep", realisation=1, mount="face-up"),
                    2.5 - math.sin(math.radians(angle_deg)) + noise_v * (-1) ** number,
                )
            ),
            index=number,
        )
        for number, angle_deg in enumerate(angles_deg)
    ]


@pytest.mark.parametrize(
    ("slip_deg", "slip"),
    [(1.0, "degree"), (-1.0, "degree"), (10.0, "degree"), (10 / 60, "minute"), (20 / 60, "minute")],
)
def test_a_wrong_digit_is_guessed(slip_deg, slip):
    points = points_at([15.0 * number for number in range(20)])
    right = points_at([7.0])[0]
    found = doubt(replace(right, angle_deg=7.0 + slip_deg), points)
    assert found.slip == slip
    assert found.likely_deg == pytest.approx(7.0)


def test_a_right_reading_is_not_doubted():
    points = points_at([15.0 * number for number in range(20)])
    assert doubt(points_at([7.0])[0], points) is None


def test_nothing_is_doubted_before_enough_is_known():
    wrong = replace(points_at([7.0])[0], angle_deg=50.0)
    assert doubt(wrong, points_at([15.0 * number for number in range(8)])) is None
    assert doubt(wrong, points_at([0.0, 90.0] * 10)) is None
    assert doubt(replace(wrong, voltage_v=math.nan), points_at([15.0 * number for number in range(20)])) is None


def test_what_no_wrong_digit_explains_is_said_to_be_so():
    points = points_at([15.0 * number for number in range(20)])
    assert doubt(replace(points_at([7.0])[0], voltage_v=9.0), points).likely_deg is None


def test_the_circle_of_a_head_begins_anew_with_every_turn():
    assert [on_the_circle(angle) for angle in (395.0, -90.0, 360.0, 359.99999999)] == [
        "35° 00′ 00″",
        "270° 00′ 00″",
        "0° 00′ 00″",
        "0° 00′ 00″",
    ]


def test_a_pause_takes_the_request_back_and_puts_it_again():
    clock = VirtualClock()
    operator = ScriptedOperator(Answers(readings={"default": ""}))
    eyepiece = OperatorEyepiece(operator, clock, 0.01)
    head = ManualHead(eyepiece, clock, limits_deg=(0.0, 90.0), speed_deg_s=5.0)
    head.start_move(30.0)
    head.stop()
    head.start_move(30.0)
    assert head.status().angle_deg == 30.0


def test_a_point_is_taken_again_while_the_next_setting_is_awaited():
    wished = []

    def hear(control, event):
        if isinstance(event, ReadingRequested) and event.setting_deg == 90.0 and not wished:
            wished.append(event)
            control.take_again(2)

    outcome, sink = run({"default": ""}, hear=hear)
    assert outcome.reason is FinishReason.COMPLETED
    assert [event.setting_deg for event in sink.of(ReadingRequested)][:6] == [0.0, 30.0, 60.0, 90.0, 60.0, 90.0]
    assert [point.take for point in outcome.points] == [1, 1, 2, *[1] * 9]
    assert [point.positions_deg["head"] for point in outcome.points] == [30.0 * number for number in range(12)]
