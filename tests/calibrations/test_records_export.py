"""A record as a JSON document."""

import json
from datetime import UTC, date, datetime

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from records_examples import KX_INSIDE, calibration, provenance

from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.records.canonical import canonical_text, plain
from tumble.calibrations.records.export import document, document_text, is_intact
from tumble.calibrations.records.store import Store


@pytest.fixture(scope="module")
def record(tmp_path_factory):
    return Store(tmp_path_factory.mktemp("store")).add(entry(calibration(), [KX_INSIDE]), provenance())


def test_a_document_says_what_it_is_and_holds_the_whole_chain(record):
    exported = document(record)
    assert exported["schema"] == "tumble.record/5"
    assert exported["result"] == calibration().as_json() | {"verdict": exported["verdict"]}
    assert [each["sha256"] for each in exported["provenance"]["sources"]] == list(record.provenance.source_hashes)
    assert (exported["method"], exported["method_version"], exported["sequence"]) == ("dividing_head", 1, 1)
    assert exported["limits"] == [{"name": "kx", "minimum": 0.95, "maximum": 1.05, "inside": True}]
    assert (exported["verdict"]["outcome"], exported["revision"], exported["supersedes"]) == ("pass", 1, None)


def test_the_text_is_the_document_on_one_line(record):
    text = document_text(record)
    assert text.count("\n") == 1
    assert text.endswith("}\n")
    assert json.loads(text) == document(record)
    assert "Олена" in text


def test_an_exported_text_carries_the_hash_that_proves_it(record):
    exported = json.loads(document_text(record))
    assert is_intact(exported)
    assert not is_intact(exported | {"verdict": "outside"})
    assert not is_intact({key: value for key, value in exported.items() if key != "content_sha256"})


def test_the_spelling_does_not_depend_on_the_order_of_keys():
    assert canonical_text({"b": 1.0, "a": "°"}) == canonical_text({"a": "°", "b": 1.0}) == '{"a":"°","b":1.0}'


def test_what_json_lacks_becomes_what_it_has():
    content = {"due": date(2027, 1, 31), "at": datetime(2026, 1, 1, tzinfo=UTC), "pair": (np.float64(1.5), np.int64(2))}
    assert plain(content | {"nan": float("nan"), "inf": [np.inf]}) == {
        "due": "2027-01-31",
        "at": "2026-01-01T00:00:00+00:00",
        "pair": [1.5, 2],
        "nan": None,
        "inf": [None],
    }


def test_what_has_no_form_in_json_is_refused():
    with pytest.raises(TypeError, match=r"a record cannot hold .* of type object"):
        plain({"thing": object()})


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
    max_leaves=10,
)


@settings(max_examples=40)
@given(st.dictionaries(st.text(), JSON, max_size=4))
def test_every_number_and_text_survives_the_canonical_spelling(content):
    assert json.loads(canonical_text(plain(content))) == content
