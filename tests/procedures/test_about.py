"""A programme is described by the comment at its beginning."""

import pytest

from tumble.procedures.about import about
from tumble.procedures.programmes import about_programme, shipped_programmes


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("# Flips, then\n# a sweep.\nname = 'x'\n# of no concern\n", "Flips, then a sweep."),
        ("\ufeff# Flips, as Notepad saves them.\n", "Flips, as Notepad saves them."),
        ("\n\n#Flips.\n\n# another\n", "Flips."),
        ("name = 'x'  # a remark\n", ""),
        ("", ""),
    ],
)
def test_it_is_the_comment_before_everything_else_on_one_line(text, said):
    assert about(text) == said


@pytest.mark.parametrize("name", shipped_programmes())
def test_every_programme_that_comes_along_says_what_it_is_for(name):
    assert about_programme(name).endswith(".")


def test_one_of_no_method_at_all_says_it_too(tmp_path):
    (tmp_path / "other.toml").write_text("# For another stand.\nmethod = 'unheard-of'\n", encoding="utf-8")
    assert about_programme(tmp_path / "other.toml") == "For another stand."
