"""A stand file is changed as a whole or not at all, and what it was is kept."""

from datetime import UTC, datetime

import pytest

from tumble.app import stand_editing
from tumble.app.stand_editing import save_stand
from tumble.procedures.errors import InputError

BEFORE = """\
name = "bench-1"

[head]
driver = "simulated"
limits_deg = [-180.0, 760.0]

[daq]
driver = "simulated"

[simulated]
preset = "DXL203EB"
"""
AFTER = BEFORE.replace("bench-1", "bench-2")
NOW = datetime(2026, 11, 27, 23, 5, 1, tzinfo=UTC)


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "bench.toml"
    path.write_text(BEFORE, encoding="utf-8")
    return path


def test_the_new_text_is_written_and_the_former_kept(path):
    assert save_stand(path, AFTER, BEFORE, NOW).file.name == "bench-2"
    assert path.read_text("utf-8") == AFTER
    assert path.with_name("bench.toml.20261127T230501Z").read_text("utf-8") == BEFORE
    assert len(list(path.parent.iterdir())) == 2


def test_what_the_loader_refuses_is_not_written(path):
    with pytest.raises(InputError, match=r"bench\.toml, line 4: head: driver"):
        save_stand(path, AFTER.replace('driver = "simulated"\nlimits', 'driver = "bent"\nlimits'), BEFORE, NOW)
    assert [each.name for each in path.parent.iterdir()] == ["bench.toml"]
    assert path.read_text("utf-8") == BEFORE


def test_what_another_program_wrote_meanwhile_is_not_written_over(path):
    path.write_text(BEFORE + "\n", encoding="utf-8")
    with pytest.raises(InputError, match="was changed by another program"):
        save_stand(path, AFTER, BEFORE, NOW)
    assert path.read_text("utf-8") == BEFORE + "\n"


def test_a_new_file_takes_the_place_of_none(path):
    with pytest.raises(InputError, match="is there already"):
        save_stand(path, AFTER, None, NOW)
    other = path.with_name("other.toml")
    save_stand(other, AFTER, None, NOW)
    assert other.read_text("utf-8") == AFTER


def test_a_full_disk_leaves_what_was_there(path, monkeypatch):
    def fail(_number):
        raise OSError(28, "No space left on device", "bench.toml")

    monkeypatch.setattr(stand_editing.os, "fsync", fail)
    with pytest.raises(OSError, match="No space"):
        save_stand(path, AFTER, BEFORE, NOW)
    assert path.read_text("utf-8") == BEFORE
    assert [each.name for each in path.parent.iterdir()] == ["bench.toml"]


def test_a_link_stays_a_link(path):
    link = path.with_name("link.toml")
    link.symlink_to(path)
    save_stand(link, AFTER, BEFORE, NOW)
    assert link.is_symlink()
    assert path.read_text("utf-8") == AFTER
