"""Every command and every piece of Python in README and pages runs as printed, from the root of a clone."""

import sys

import pytest
from app_jobs import cheaply, tracing_once
from page_blocks import PAGES, ROOT, blocks_of, run_page

WITH_BLOCKS = [page for page in PAGES if any(not block.reason for block in blocks_of(page))]


@pytest.fixture
def clone(tmp_path, monkeypatch):
    """A folder that looks like the root of a clone, but may be written to."""
    (tmp_path / "docs").symlink_to(ROOT / "docs", target_is_directory=True)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.skipif(sys.platform == "win32", reason="a link to the folder of the samples needs rights there")
@pytest.mark.parametrize("page", WITH_BLOCKS, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_what_a_page_shows_runs(page, clone, capsys):
    with cheaply(blank="figures"), tracing_once():
        run_page(page)


def test_the_tutorial_and_the_readme_are_among_them():
    assert {ROOT / "README.md", ROOT / "docs" / "tutorial.md"} <= set(WITH_BLOCKS)


def test_a_block_that_is_not_run_says_why():
    reasons = [block.reason for page in PAGES for block in blocks_of(page) if block.reason]

    assert reasons
    assert all(len(reason) > 10 for reason in reasons)
