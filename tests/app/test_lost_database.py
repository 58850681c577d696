"""A store whose database is gone: no run begins a second chain of records in its place."""

import pytest

from tumble.app.calibrating import make_ready
from tumble.app.exits import JobError


def test_nothing_is_measured_for_a_store_whose_database_is_gone(tmp_path):
    make_ready(tmp_path)
    (tmp_path / "reports" / "20261128-230221-42f3ed.html").write_text("<html></html>", encoding="utf-8")
    (tmp_path / "records.sqlite").unlink()
    with pytest.raises(JobError, match=r"records\.sqlite: this database is gone, and .*; nothing was measured"):
        make_ready(tmp_path)
    assert not (tmp_path / "records.sqlite").exists()


def test_a_store_that_has_no_records_yet_is_begun(tmp_path):
    (tmp_path / "reports").mkdir()
    (tmp_path / "reports" / "notes.html").write_text("<html></html>", encoding="utf-8")
    make_ready(tmp_path)
    assert (tmp_path / "records.sqlite").is_file()
