"""The site: every page is in the contents, every link leads somewhere, and no equation needs the network."""

import re

import pytest
from page_blocks import PAGES, ROOT, links_of

DOCS = ROOT / "docs"
INDEX = (DOCS / "index.md").read_text("utf-8")
CONTENTS = re.findall(r"^```\{toctree\}\n(?:.*\n)*?\n((?:.+\n)+)```", INDEX, re.M)


def test_every_page_is_in_the_contents():
    listed = {place for part in CONTENTS for place in part.split()}
    pages = {page.relative_to(DOCS).with_suffix("").as_posix() for page in PAGES if DOCS in page.parents}
    notebooks = {path.relative_to(DOCS).with_suffix("").as_posix() for path in DOCS.glob("notebooks/*.ipynb")}
    decisions = {page for page in pages if page.startswith("decisions/0")}

    assert pages - decisions - {"index"} | notebooks == listed - {"decisions/0*"}


@pytest.mark.parametrize("page", [*PAGES, ROOT / "CONTRIBUTING.md"], ids=lambda page: page.relative_to(ROOT).as_posix())
def test_links_lead_somewhere(page):
    assert [target for target in links_of(page) if not (page.parent / target).exists()] == []


def test_a_path_outside_the_repository_is_in_no_page():
    assert [page.name for page in PAGES if re.search(r"(?<![\w.])/(work|home|tmp)/\w", page.read_text("utf-8"))] == []


def test_what_needs_files_of_others_sits_with_the_measured_tables():
    elsewhere = [path for path in (ROOT / "tests").rglob("test_*.py") if path.parent.name != "measured"]
    needing = re.compile(r"def \w+\((?:.*, )?shared[,)]|parents\[\d\]\.parent / ")

    assert [path.name for path in elsewhere if needing.search(path.read_text("utf-8"))] == []
