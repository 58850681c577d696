import io
from dataclasses import replace

import pytest
from app_jobs import STAND, tumble
from cut_runs import TWICE, measured

from tumble.app.resuming import _elapsed_s, find
from tumble.drivers.clock import ReleasedClock
from tumble.procedures.recording.reader import read_recording


def test_a_stand_file_that_was_changed_is_refused_and_nothing_touched(cut, stand, tmp_path):
    _, broken = cut(5, "--stand", stand)
    stand.write_text(STAND + "seed = 2\n", encoding="utf-8")
    ran = tumble("resume", broken)
    assert ran.status == 2
    assert ran.complaint.startswith(f"{stand}: is not the stand file with which {broken} was begun")
    assert not list(tmp_path.glob("run.cut*"))


def test_the_stand_file_may_have_been_moved(cut, stand, tmp_path):
    _, broken = cut(5, "--stand", stand)
    stand.rename(tmp_path / "elsewhere.toml")
    assert tumble("resume", broken).status == 2
    assert tumble("resume", broken, "--stand", tmp_path / "elsewhere.toml").status == 0


def test_a_programme_that_was_altered_in_the_recording_is_refused(cut):
    _, broken = cut(5)
    unfinished = find(broken)
    header = replace(unfinished.recording.header, programme_text=TWICE.replace("60.0", "61.0"))
    altered = replace(unfinished, recording=replace(unfinished.recording, header=header))
    with pytest.raises(Exception, match="its programme is not the one that was begun"):
        _ = altered.programme


def test_a_file_that_is_not_there_is_named(tmp_path):
    ran = tumble("resume", tmp_path / "none.mcap")
    assert ran.status == 2
    assert str(tmp_path / "none.mcap") in ran.complaint


def test_a_stand_that_measures_something_else_ends_with_status_3_and_loses_nothing(cut, monkeypatch):
    whole, broken = cut(8)
    with monkeypatch.context() as patched:
        patched.setattr("tumble.procedures.verification.allowed", lambda *_: 1e-9)
        ran = tumble("resume", broken)
    assert ran.status == 3
    assert "look whether the unit, its mount or its wiring has changed" in ran.complaint
    assert f"8 complete points kept in {broken}" in ran.complaint
    assert tumble("resume", broken).status == 0
    assert measured(read_recording(broken)) == measured(read_recording(whole))


def test_an_attended_stand_goes_on_in_real_time(cut, monkeypatch):
    _, broken = cut(19)
    monkeypatch.setattr("sys.stdin", io.StringIO("face-up\n" * 3))
    slept = []
    monkeypatch.setattr("tumble.drivers.clock.time.sleep", slept.append)
    monkeypatch.setattr("tumble.drivers.clock.time.monotonic", lambda: sum(slept))
    ran = tumble("resume", broken, "--attended")
    assert ran.status == 0, ran.err
    assert 1.0 < sum(slept) < 200.0


def test_a_clock_that_is_released_runs_on_from_where_it_was(monkeypatch):
    now = [100.0]
    monkeypatch.setattr("tumble.drivers.clock.time.monotonic", lambda: now[0])
    monkeypatch.setattr("tumble.drivers.clock.time.sleep", lambda duration_s: now.__setitem__(0, now[0] + duration_s))
    clock = ReleasedClock(wall_start_ns=0)
    clock.sleep(5.0)
    assert (clock.monotonic_s(), now[0]) == (5.0, 100.0)
    clock.release()
    clock.sleep(2.0)
    clock.sleep(-1.0)
    assert (clock.monotonic_s(), now[0], clock.wall_ns()) == (7.0, 102.0, 7 * 10**9)


class RealStand:
    """A stand that lived on by itself, whose wall clock says what a test wants."""

    lived_s = None

    def __init__(self, wall_ns):
        self.stand = self.clock = self
        self.wall_ns = lambda: wall_ns


@pytest.mark.parametrize(("later_s", "counted_s"), [(60.0, 60.0), (-86_400.0, 0.0)], ids=["later", "clock set back"])
def test_at_a_real_stand_the_outage_is_counted_by_the_wall_clock_where_that_rose(cut, later_s, counted_s):
    _, broken = cut(5)
    unfinished = find(broken)
    real = RealStand(unfinished.last.log_time_ns + round(later_s * 1e9))
    assert _elapsed_s(unfinished, real) == pytest.approx(unfinished.elapsed_s + counted_s)
    assert unfinished.elapsed_s >= unfinished.recording.points[-1].time_s
