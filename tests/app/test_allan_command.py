import json

import numpy as np
import pytest
from app_jobs import tumble

import tumble as product
from tumble.procedures.programmes import load_programme, with_dwell


@pytest.fixture(scope="module")
def still(tmp_path_factory):
    """A slow wander under white noise: a recording of half an hour at 1 Hz."""
    path = tmp_path_factory.mktemp("still") / "still.csv"
    random = np.random.default_rng(11)
    values = 1e-5 * random.standard_normal(2048) + 3e-6 * np.cumsum(random.standard_normal(2048))
    lines = [f"{second},{value:.9f}" for second, value in enumerate(values)]
    path.write_text("time_s,u_x_V\n" + "\n".join(lines) + "\n", "utf-8")
    return path


def test_kinds_of_noise_and_the_best_time_are_printed(still):
    ran = tumble("allan", still)

    assert ran.status == 0, ran.err
    assert "Random walk K" in ran.out
    assert "µV·√s" in ran.out
    assert "A dwell of" in ran.out


def test_a_programme_takes_its_dwell_from_the_recording(still, tmp_path):
    ran = tumble("allan", still, "--programme", "24", "--out", tmp_path / "mine.toml", "--json", tmp_path / "a.json")

    assert ran.status == 0, ran.err
    dwell_s = json.loads((tmp_path / "a.json").read_text("utf-8"))["dwell_s"]
    programme = load_programme(tmp_path / "mine.toml")
    assert programme.dwell_s == pytest.approx(dwell_s, abs=0.1)
    assert len(programme.parts) == len(load_programme("24").parts)


def test_the_report_is_a_page_with_the_curve(still, tmp_path):
    ran = tumble("allan", still, "--report", tmp_path / "a.html")

    assert ran.status == 0, ran.err
    assert "<svg" in (tmp_path / "a.html").read_text("utf-8")


def test_a_programme_without_a_place_is_wrong_usage(still):
    assert tumble("allan", still, "--programme", "24").status == 2


def test_an_output_that_never_changes_is_refused_in_a_sentence(tmp_path):
    (tmp_path / "a.csv").write_text("u_x_V\n" + "1\n" * 300, "utf-8")

    ran = tumble("allan", tmp_path / "a.csv", "--rate", "10")

    assert (ran.status, ran.out) == (2, "")
    assert "column u_x_V: never changes" in ran.err


def test_a_script_has_the_same(still):
    found = product.allan(still)

    assert found.outputs["u_x_V"].best.low_s <= found.outputs["u_x_V"].best.high_s
    assert found.document()["dwell_s"] == found.dwell_s


@pytest.mark.parametrize(
    "text",
    [
        'name = "a"\ndwell_s = 2.0\n\n[[procedure]]\nlist = "6"\n',
        'name = "a"\nsamples = 50\n[[procedure]]\nlist = "6"\n',
        'name = "a"\n\n[[procedure]]\nlist = "6"\ndwell_s = 3.0\n',
    ],
)
def test_the_dwell_of_a_programme_is_put_in_the_place_of_its_own(text):
    head, _, rest = with_dwell(text, 12.5).partition("[[procedure]]")

    assert head.count("dwell_s = 12.5") == 1
    assert "samples" not in head
    assert "dwell_s = 2.0" not in head
    assert rest == text.partition("[[procedure]]")[2]
