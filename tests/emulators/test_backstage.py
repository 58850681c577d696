import json
from contextlib import contextmanager

import pytest

from tumble.drivers.clock import SystemClock, VirtualClock
from tumble.drivers.errors import DeviceError
from tumble.drivers.simulated import HeadOptions, Simulated, build
from tumble.emulators.backstage import backstage_of, find_backstage
from tumble.emulators.speed import FasterClock
from tumble.emulators.world import SharedWorld

ADDRESS = "socket://127.0.0.1:1"


@pytest.fixture(autouse=True)
def _own_folder(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    monkeypatch.setenv("LOCALAPPDATA", str(tmp_path))


@contextmanager
def found(clock):
    """The world of an emulated stand, and its backstage as a client finds it."""
    shared = SharedWorld(build(Simulated(), clock=clock, head=HeadOptions()))
    with backstage_of(shared, (ADDRESS,)):
        yield shared, find_backstage(("", ADDRESS))


def test_nobody_is_found_where_nothing_is_emulated():
    assert find_backstage((ADDRESS,)) is None


def test_a_stand_is_found_by_another_name_of_its_address():
    with found(VirtualClock()):
        assert find_backstage(("socket://localhost:1?logging=debug",)) is not None


def test_a_client_lives_by_the_clock_of_the_emulated_stand():
    clock = FasterClock(50.0)
    with found(clock) as (_, people):
        before_s, before_ns = clock.monotonic_s(), clock.wall_ns()
        theirs_s, theirs_ns = people.clock.monotonic_s(), people.clock.wall_ns()
        assert before_s <= theirs_s <= clock.monotonic_s()
        assert before_ns <= theirs_ns <= clock.wall_ns()


def test_a_stand_in_virtual_time_has_no_clock_to_live_by():
    with found(VirtualClock()) as (_, people):
        assert isinstance(people.clock, SystemClock)


def test_a_head_is_turned_by_hand():
    clock = VirtualClock()
    with found(clock) as (shared, people):
        people.turn(12.5)
        assert people.turning()
        clock.sleep(10.0)
        assert not people.turning()
        assert shared.head.status().angle_deg == 12.5


def test_a_hand_may_let_go():
    clock = VirtualClock()
    with found(clock) as (shared, people):
        people.turn(100.0)
        clock.sleep(1.0)
        people.let_go()
        assert not people.turning()
        assert 0.0 < shared.head.status().angle_deg < 100.0


@pytest.mark.parametrize("line", ["turn round", "turn 1e9", "look away", "seat nowhere", "dance"])
def test_what_cannot_be_done_is_told(line):
    with found(VirtualClock()) as (_, people), pytest.raises(DeviceError, match=f"emulated stand: {line}: "):
        people._tell(line)


def test_an_entry_that_is_no_entry_is_passed_over(tmp_path):
    with found(VirtualClock()):
        (entry,) = tmp_path.glob("tumble/emulated/*.json")
        for text in ("", "{}", json.dumps({"port": 1, "pace": {"factor": -1.0}})):
            entry.write_text(text)
            assert find_backstage((ADDRESS,)) is None


def test_an_entry_of_a_process_that_is_gone_is_passed_over(tmp_path):
    with found(VirtualClock()):
        (entry,) = tmp_path.glob("tumble/emulated/*.json")
        known = json.loads(entry.read_text())
        for changed in ({"started": "1"}, {"process": 2**22 + 1}, {"started": ""}):
            entry.write_text(json.dumps(known | changed))
            assert find_backstage((ADDRESS,)) is None
        entry.write_text(json.dumps(known))
        assert find_backstage((ADDRESS,)) is not None


def test_an_entry_in_the_temporary_folder_is_nobodys(tmp_path, monkeypatch):
    with found(VirtualClock()):
        (entry,) = tmp_path.glob("tumble/emulated/*.json")
        anybody = tmp_path / "tumble-emulated-operator"
        anybody.mkdir()
        entry.rename(anybody / entry.name)
        monkeypatch.setenv("TMPDIR", str(tmp_path))
        assert find_backstage((ADDRESS,)) is None
