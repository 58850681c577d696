from dataclasses import replace
from functools import partial

import pytest
from fakes import FakeStand, point_at
from hypothesis import given
from hypothesis import strategies as st

from tumble.procedures.errors import JournalError
from tumble.procedures.events import ConditionAnswered, FinishReason, PointCompleted, StepStarted
from tumble.procedures.methods.dividing_head.layout import MOUNT, dwell_at, mounting
from tumble.procedures.methods.dividing_head.rows import row_of
from tumble.procedures.operator import Answer
from tumble.procedures.programmes import programme_from_text
from tumble.procedures.replay import replay
from tumble.procedures.steps import Confirmed, Dwell

PARTS = [
    '[[procedure]]\nkind = "flip"\naxes = ["x", "z"]\npole = "extremum"\n',
    '[[procedure]]\nkind = "flip"\naxes = ["y"]\n',
    '[[procedure]]\nkind = "sweep"\nmount = "end"\nstep_deg = -30\npoints = 3\norder = "there-and-back"\n',
    '[[procedure]]\nkind = "sweep"\nmount = "face-up"\nstep_deg = 30\npoints = 4\norder = "shuffled"\nseed = 7\n',
]

PROGRAMMES = st.builds(
    lambda parts, realisations: f'name = "any"\nrealisations = {realisations}\n' + "".join(parts),
    st.lists(st.sampled_from(PARTS), min_size=1, max_size=3),
    st.integers(1, 2),
)

SWEEP = programme_from_text('name = "a"\n[[procedure]]\nkind = "sweep"\nstep_deg = 5\npoints = 3\n', "a.toml")


def procedure_of(text):
    return programme_from_text(text, "any.toml").procedure


def fast_stand():
    stand = FakeStand()
    stand.head.speed_deg_s = 1e4
    return stand


def steps(stand):
    return [event.step for event in stand.sink.of(StepStarted)]


def journal(stand):
    """The replies in a recording, in order."""
    for event in stand.sink.events:
        match event:
            case ConditionAnswered(confirmed=True):
                yield Confirmed(condition=event.condition, value=event.value)
            case PointCompleted():
                yield event.point


@given(text=PROGRAMMES, data=st.data())
def test_a_run_cut_anywhere_goes_on_as_if_it_had_not_been(text, data):
    whole, resumed = fast_stand(), fast_stand()
    expected = whole.engine().run(procedure_of(text))
    cut = data.draw(st.integers(0, len(expected.points)), label="points before the cut")

    if cut:
        resumed.head.start_move(expected.points[cut - 1].positions_deg["head"])
        resumed.clock.sleep(60.0)
    outcome = resumed.engine().resume(procedure_of(text), expected.points[:cut])

    assert outcome.reason is FinishReason.COMPLETED
    assert [replace(point, time_s=0.0) for point in outcome.points] == [
        replace(point, time_s=0.0) for point in expected.points
    ]
    dwells_before = [step for step in steps(whole) if isinstance(step, Dwell)][:cut]
    dwells_after = [step for step in steps(resumed) if isinstance(step, Dwell)]
    assert dwells_before + dwells_after == [step for step in steps(whole) if isinstance(step, Dwell)]


@given(cut=st.integers(0, 25))
def test_a_run_resumed_twice_goes_on_from_its_whole_journal(cut):
    text = "".join(['name = "any"\n', *PARTS])
    first, second, third = fast_stand(), fast_stand(), fast_stand()
    first.sink.fails_at = lambda event: isinstance(event, PointCompleted) and event.point.index == cut // 2
    first.engine().run(procedure_of(text))
    second.sink.fails_at = lambda event: isinstance(event, PointCompleted) and event.point.index == cut
    second.engine().resume(procedure_of(text), list(journal(first)))
    outcome = third.engine().resume(procedure_of(text), [*journal(first), *journal(second)])
    assert outcome.reason is FinishReason.COMPLETED
    assert [point.index for point in outcome.points] == list(range(14 + 2 + 2 + 5 + 4))


def test_the_mount_is_confirmed_again_before_anything_moves(stand: FakeStand):
    begun = FakeStand().engine().run(SWEEP.procedure).points[:2]
    stand.operator.answer = Answer(text="no", confirmed=False)
    outcome = stand.engine().resume(SWEEP.procedure, begun)
    assert outcome.reason is FinishReason.UNANSWERED
    assert stand.operator.asked == ["face-up"]
    assert stand.head.targets_deg == []


def test_the_last_mount_is_gone_back_to_before_a_change_that_is_due(stand: FakeStand):
    text = "".join(['name = "a"\n', PARTS[1], PARTS[2]])
    begun = FakeStand().engine().run(procedure_of(text)).points[:2]
    stand.engine().resume(procedure_of(text), begun)
    assert stand.operator.asked == ["face-up", "end"]


def test_a_run_that_was_complete_is_complete_at_once(stand: FakeStand):
    begun = FakeStand().engine().run(SWEEP.procedure).points
    outcome = stand.engine().resume(SWEEP.procedure, begun)
    assert (outcome.reason, outcome.points) == (FinishReason.COMPLETED, begun)
    assert stand.operator.asked == []


@pytest.mark.parametrize(("elapsed_s", "least_s"), [(0.0, 0.3), (500.0, 500.0)])
def test_time_goes_on_from_the_beginning_of_the_run(stand: FakeStand, elapsed_s, least_s):
    begun = FakeStand().engine().run(SWEEP.procedure).points[:2]
    last = stand.engine().resume(SWEEP.procedure, begun, elapsed_s=lambda: elapsed_s).points[2]
    assert least_s < last.time_s < least_s + 5.0
    assert last.time_s > begun[1].time_s


def test_the_direction_before_the_cut_holds_until_the_next_move(stand: FakeStand):
    still = programme_from_text(SWEEP.text.replace("step_deg = 5", "step_deg = 0\nstart_deg = -40"), "a.toml")
    begun = FakeStand().engine().run(still.procedure).points[:2]
    stand.head.start_move(-40.0)
    stand.clock.sleep(60.0)
    assert [point.directions["head"] for point in stand.engine().resume(still.procedure, begun).points] == [
        -1,
        -1,
        -1,
    ]


AT = partial(dwell_at, procedure="sweep", realisation=1, mount="face-up")
SECOND = AT(angle_deg=5.0)


def test_a_reported_angle_may_differ_by_the_tolerance():
    points = [point_at(AT(angle_deg=0.009)), point_at(AT(angle_deg=4.991), index=1)]
    assert replay(SWEEP.procedure(), points, 0.01).pending == AT(angle_deg=10.0)


@pytest.mark.parametrize(
    ("other", "seen"),
    [
        ({"angle_deg": 6.0}, "point 1 (sweep, realisation 1, face-up at 6 deg)"),
        ({"angle_deg": float("nan")}, "point 1 (sweep, realisation 1, face-up at nan deg)"),
        ({"mount": "edge"}, "point 1 (sweep, realisation 1, edge at 5 deg)"),
        ({"procedure": "flip"}, "point 1 (flip, realisation 1, face-up at 5 deg)"),
        ({"realisation": 2}, "point 1 (sweep, realisation 2, face-up at 5 deg)"),
        ({"index": 2}, "point 2 (sweep, realisation 1, face-up at 5 deg)"),
    ],
)
def test_a_recording_of_another_programme_is_refused_before_anything_moves(stand: FakeStand, other, seen):
    points = [point_at(AT(angle_deg=0.0)), replace(row_of(point_at(SECOND, index=1)), **other).point]
    with pytest.raises(JournalError) as raised:
        stand.engine().resume(SWEEP.procedure, points)
    assert str(raised.value) == (
        f"the recorded run does not belong to this programme: where it has {seen}, the programme has point 1 (sweep, "
        "realisation 1, face-up at 5 deg) after 1 point; resume it with the programme that it was begun with"
    )
    assert stand.sink.events == []
    assert stand.head.targets_deg == []


def test_a_recording_that_is_longer_than_the_programme_is_refused():
    points = [point_at(AT(angle_deg=5.0 * index), index=index) for index in range(4)]
    with pytest.raises(JournalError, match="the programme is over after 3 points"):
        replay(SWEEP.procedure(), points, 0.01)


def test_the_reply_to_a_mounting_alone_leaves_it_pending():
    replayed = replay(SWEEP.procedure(), [Confirmed(condition=MOUNT, value="face-up")], 0.01)
    assert (replayed.points, replayed.pending) == ((), mounting("face-up"))
