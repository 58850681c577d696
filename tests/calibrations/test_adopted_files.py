"""Adopted effects as files: they come back, and what is broken says so in one sentence."""

import json
from datetime import UTC, datetime

import numpy as np
import pytest
from adopted_examples import effect

from tumble.calibrations.adopted.document import document, effect_from, hashed
from tumble.calibrations.adopted.effect import OfStand
from tumble.calibrations.adopted.folder import Retired, check_effect_name, kept, kept_in, taken
from tumble.calibrations.stand_records.record import StandIdentity


def written(path, content):
    path.write_text(json.dumps(content), "utf-8")
    return path


@pytest.fixture
def path(tmp_path):
    return written(tmp_path / "odd_bump.json", document(effect()))


def retired(of):
    return Retired(
        name=of.name,
        effect_sha256=of.content_sha256,
        reason="a new batch of seals",
        operator="",
        retired_at=datetime(2026, 12, 1, tzinfo=UTC),
    ).document()


def test_an_effect_comes_back_from_its_file(path):
    there, back = effect(), kept(path).effect

    assert document(back) == document(there)
    assert np.array_equal(back.curve.covariance, there.curve.covariance)


def test_one_that_is_kept_with_a_stand_comes_back():
    identity = StandIdentity(stand="bench", head="simulated H-1", daq="simulated D-1")
    stand = effect()
    content = {
        **document(stand),
        "kept_with": {"stand": {"stand": "bench", "head": "simulated H-1", "daq": "simulated D-1"}},
    }
    del content["content_sha256"]

    assert effect_from(hashed(content)).kept_with == OfStand(identity=identity)


def test_an_effect_is_in_force_until_it_is_retired(path):
    assert kept(path).in_force

    written(path.with_name("odd_bump.retired.json"), retired(effect()))

    assert not kept(path).in_force
    assert [each.effect.name for each in kept_in(path.parent)] == ["odd_bump"]


def altered(content):
    return {**content, "spread": 0.9}


@pytest.mark.parametrize(
    ("spoil", "what"),
    [
        (lambda text: json.dumps(altered(json.loads(text))), "it was altered or damaged since it was written"),
        (lambda text: text[: len(text) // 2], "it is no JSON"),
        (lambda _: "", "it is no JSON"),
        (lambda _: "[" * 200_000, "it is no JSON"),
        (lambda _: "[]", "it is no tumble.adopted-effect"),
        (lambda _: '{"schema": "tumble.loop/1"}', "it is no tumble.adopted-effect"),
        (lambda text: text.replace("adopted-effect/1", "adopted-effect/2"), "of schema tumble.adopted-effect/2"),
    ],
)
def test_a_file_that_cannot_be_used_says_why_and_what_to_do(path, spoil, what):
    path.write_text(spoil(path.read_text("utf-8")), "utf-8")

    with pytest.raises(ValueError, match=what) as refused:
        kept(path)

    assert str(refused.value).startswith(f"{path}: cannot be used: ")
    assert str(refused.value).endswith("; put a copy back, or move the file away and adopt anew")


@pytest.mark.parametrize("key", ["curve", "units", "kept_with", "adopted_at", "channel"])
def test_a_file_that_lacks_something_says_what(path, key):
    content = {each: value for each, value in document(effect()).items() if each not in (key, "content_sha256")}
    written(path, hashed(content))

    with pytest.raises(ValueError, match=f"'{key}' is missing or is not what it should be"):
        kept(path)


def test_a_covariance_of_another_size_is_refused(path):
    content = document(effect())
    del content["content_sha256"]
    content["curve"]["covariance"] = [[1.0]]
    written(path, hashed(content))

    with pytest.raises(ValueError, match="cannot be used"):
        kept(path)


def test_what_retires_another_effect_is_refused(path):
    written(path.with_name("odd_bump.retired.json"), retired(effect(spread=0.5)))

    with pytest.raises(ValueError, match="it retires another effect than the one beside it"):
        kept(path)


@pytest.mark.parametrize("name", ["", "a b", "../a", "a/b", "a.b", "1st", "con", "COM3", "x" * 65, "é"])
def test_what_can_be_no_file_everywhere_can_be_no_name(name):
    with pytest.raises(ValueError, match="cannot be the name of an effect"):
        check_effect_name(name)


def test_names_are_taken_whatever_their_capitals(path):
    path.rename(path.with_name("Odd_Bump.json"))

    assert taken(path.parent) == {"odd_bump"}


def test_without_a_folder_there_is_no_effect(tmp_path):
    assert kept_in(tmp_path / "none") == ()
