"""Verification: the raw file, the record and the numbers."""

import sqlite3
from contextlib import closing
from dataclasses import replace

import pytest
from records_examples import KX_INSIDE, RAW, calibration, provenance, store_with_raw_file, sweep_only

from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.records.verify import RawFile, verify


@pytest.fixture
def store(tmp_path):
    return store_with_raw_file(tmp_path)


@pytest.fixture
def record(store):
    return store.add(entry(calibration(), [KX_INSIDE]), provenance())


def same(_paths, _stand):
    return entry(calibration())


def shifted(name, share, field="value"):
    """The calibration with one number of a parameter moved by a share of its uncertainty."""
    parameter = calibration().parameters[name]
    moved = replace(parameter, **{field: getattr(parameter, field) + share * parameter.standard_uncertainty})
    return entry(replace(calibration(), parameters=calibration().parameters | {name: moved}))


def failing(verification):
    return [check.name for check in verification.parameters if not check.agrees]


def tamper(store, trigger, statement):
    with closing(sqlite3.connect(store.path)) as connection, connection:
        connection.execute(f"DROP TRIGGER {trigger}")
        connection.execute(statement)


def test_an_untouched_record_is_verified(store, record):
    verification = verify(record, store, same, "0.1.0")
    assert verification.verified
    assert [check.name for check in verification.parameters] == ["u0", "kx", "ky", "kz", "kxy", "alpha0"]
    assert verification.sentences == (
        f"Raw file {store.folder / 'runs' / 'raw.csv'}: intact.",
        "The record is intact.",
        "Fitted again, every parameter comes back to 1e-06 of its standard uncertainty.",
    )


def test_the_raw_file_and_the_recorded_stand_are_what_is_fitted_again(store, record):
    asked = []

    def refit(paths, stand):
        asked.append((*[path.read_bytes() for path in paths], stand))
        return same(paths, stand)

    verify(record, store, refit, "0.1.0")
    assert asked == [(RAW, {"name": "bench-1", "head": {"limits_deg": [-180.0, 760.0]}})]


def never(_paths, _stand):
    raise AssertionError("nothing may be fitted")


def test_a_changed_raw_file_is_seen_and_not_fitted(store, record):
    (store.folder / "runs" / "raw.csv").write_bytes(RAW + b"90,3.5\n")
    verification = verify(record, store, never, "0.1.0")
    assert verification.sources[0].state is RawFile.CHANGED
    assert not verification.verified
    assert "Nothing was fitted again." in verification.sentences


def test_a_missing_raw_file_is_seen(store, record):
    (store.folder / "runs" / "raw.csv").unlink()
    verification = verify(record, store, never, "0.1.0")
    assert verification.sources[0].state is RawFile.MISSING
    assert not verification.verified


@pytest.mark.parametrize(
    ("trigger", "statement", "altered"),
    [
        ("records_no_update", "UPDATE records SET result = replace(result, '\"V/g\"', '\"mV/g\"')", {"content"}),
        (
            "records_no_update",
            "UPDATE records SET models = replace(models, '\"V/g\"', '\"mV/g\"')",
            {"content", "parameters"},
        ),
        ("records_no_update", "UPDATE records SET operator = 'somebody else'", {"column operator"}),
        ("records_no_update", "UPDATE records SET outcome = 'fail'", {"column outcome"}),
        (
            "records_no_update",
            "UPDATE records SET verdict = replace(verdict, 'pass', 'fail')",
            {"content", "column outcome"},
        ),
        ("records_no_update", "UPDATE records SET method = 'another'", {"content"}),
        ("records_no_update", "UPDATE records SET sequence = 2", {"content"}),
        ("records_no_update", "UPDATE records SET sources = '[]'", {"column sources"}),
        ("parameters_no_update", "UPDATE parameters SET value = 1.5 WHERE name = 'kx'", {"parameters"}),
        ("parameters_no_delete", "DELETE FROM parameters WHERE name = 'kx'", {"parameters"}),
    ],
)
def test_tampering_past_the_triggers_is_seen(store, record, trigger, statement, altered):
    tamper(store, trigger, statement)
    verification = verify(store.get(record.id), store, same, "0.1.0")
    assert set(verification.altered) == altered
    assert not verification.verified
    assert any(line.startswith("Altered in the store: ") for line in verification.sentences)


@pytest.mark.parametrize("field", ["value", "standard_uncertainty"])
def test_a_number_that_moved_by_more_than_the_tolerance_does_not_come_back(store, record, field):
    verification = verify(record, store, lambda *_: shifted("kx", 2e-6, field), "0.1.0")
    assert failing(verification) == ["kx"]
    assert "Fitted again, these do not come back: kx." in verification.sentences


def test_rounding_is_tolerated(store, record):
    assert verify(record, store, lambda *_: shifted("kx", -5e-7), "0.1.0").verified


def test_a_value_that_the_refit_does_not_identify_does_not_come_back(store, record):
    assert "kz" in failing(verify(record, store, lambda *_: entry(sweep_only()), "0.1.0"))


def test_a_value_that_stands_for_another_alpha0_does_not_come_back(store, record):
    given = replace(calibration().parameters["ky"], given={"alpha0": 0.0})
    again = replace(calibration(), parameters=calibration().parameters | {"ky": given})
    assert failing(verify(record, store, lambda *_: entry(again), "0.1.0")) == ["ky"]


def test_a_parameter_that_the_refit_does_not_have_does_not_come_back(store, record):
    rest = {name: parameter for name, parameter in calibration().parameters.items() if name != "kxy"}
    again = replace(calibration(), parameters=rest)
    (check,) = [
        check for check in verify(record, store, lambda *_: entry(again), "0.1.0").parameters if not check.agrees
    ]
    assert (check.name, check.refitted) == ("kxy", None)


def test_a_null_comes_back_as_null(store):
    record = store.add(entry(sweep_only()), provenance())
    assert verify(record, store, lambda *_: entry(sweep_only()), "0.1.0").verified


def test_another_program_version_is_said_and_does_no_harm(store, record):
    verification = verify(record, store, same, "0.2.0")
    assert verification.verified
    assert verification.sentences[-1] == "Recorded with version 0.1.0, verified with 0.2.0."
