"""A run that is discarded is moved aside with all its files, and none is lost."""

import pytest

from tumble.app.discarding import discard
from tumble.app.exits import JobError
from tumble.app.stand_lock import holding_recording
from tumble.procedures.errors import InputError


@pytest.fixture
def run(tmp_path):
    """A recording, and what was set aside of it."""
    folder = tmp_path / "store" / "recordings" / "SN-1"
    folder.mkdir(parents=True)
    for name in ("run.mcap", "run.cut-1.mcap", "other.mcap"):
        (folder / name).write_text(name, encoding="utf-8")
    return folder / "run.mcap"


def test_every_file_of_the_run_is_moved_and_no_other(run, tmp_path):
    place = discard(tmp_path / "store", run)
    assert place == tmp_path / "store" / "discarded" / "SN-1" / "run"
    assert sorted(path.name for path in place.iterdir()) == ["run.cut-1.mcap", "run.mcap"]
    assert [path.name for path in run.parent.iterdir()] == ["other.mcap"]


def test_a_run_of_the_same_name_that_was_discarded_before_is_kept(run, tmp_path):
    discard(tmp_path / "store", run)
    run.write_text("again", encoding="utf-8")
    place = discard(tmp_path / "store", run)
    assert place.name == "run-2"
    assert (place.with_name("run") / "run.mcap").read_text("utf-8") == "run.mcap"


def test_what_is_not_there_is_told(tmp_path):
    with pytest.raises(InputError, match="there is no such recording"):
        discard(tmp_path, tmp_path / "recordings" / "SN-1" / "run.mcap")


def test_a_run_that_somebody_goes_on_with_stays(run, tmp_path):
    with holding_recording(run, "SN-1"), pytest.raises(JobError, match="is in use by"):
        discard(tmp_path / "store", run)
    assert run.is_file()
