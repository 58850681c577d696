"""A method plugs in without a change elsewhere: closed loop, terminal, JSON, report, record, notebook."""

import json

import numpy as np
import pytest
from app_jobs import tumble

import tumble as package
from tumble.app import methods


@pytest.fixture
def table(tmp_path, install):
    """A table of a clock that loses two seconds an hour, where its method is installed."""
    install("tumble.methods", "clock", "toy:METHOD")
    methods.methods.cache_clear()
    noise_s = np.random.default_rng(4).normal(0.0, 0.01, 30)
    rows = [f"{hour},{5.0 + 2.0 * hour + noise_s[hour]}" for hour in range(30)]
    (tmp_path / "clock.csv").write_text("\n".join(["clock_h,late_s", *rows, ""]))
    yield tmp_path / "clock.csv"
    methods.methods.cache_clear()


def test_its_loop_is_closed_by_the_same_command(table):
    ran = tumble("close-loop", table, "--json", "-")
    (effect,) = json.loads(ran.out)["effects"]
    assert effect["name"] == "rate"
    assert effect["coefficients"]["rate_s_per_h"]["value"] == pytest.approx(2.0, abs=0.001)


def test_what_was_found_is_shown_on_the_terminal(table):
    assert "What makes it late" in tumble("close-loop", table).out


def test_its_report_is_a_page_of_its_sections(table, tmp_path):
    assert tumble("close-loop", table, "--report", tmp_path / "page.html").status == 0
    assert "A clock against a better one" in (tmp_path / "page.html").read_text("utf-8")


def test_its_result_is_a_record_that_comes_back_from_its_table(table, tmp_path):
    record = json.loads(tumble("close-loop", table, "--record", "--store", tmp_path / "s", "--json", "-").out)["record"]
    assert "method     clock, version 1" in tumble("records", "show", record, "--store", tmp_path / "s").out
    verified = tumble("records", "verify", "--store", tmp_path / "s")
    assert (verified.status, "every parameter comes back" in verified.out) == (0, True)


def test_a_notebook_reads_its_table(table):
    assert package.close_loop(table).to_dict()["method"] == "clock"


def test_a_notebook_draws_nothing_where_its_sections_have_no_figure(table):
    assert package.close_loop(table).plot().svg == ""
