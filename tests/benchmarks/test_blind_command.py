"""What the bank of tables without a name refuses to run."""

import pytest

from benchmarks.blind.__main__ import main


def test_numbers_between_which_there_is_no_table_are_refused(capsys):
    with pytest.raises(SystemExit):
        main(["--kinds", "clean", "--seed", "1", "--first", "250", "--count", "250"])
    assert "no table lies between --first and --count" in capsys.readouterr().err


def test_outcomes_that_are_there_are_not_overwritten(tmp_path, capsys):
    outcomes = tmp_path / "outcomes.json"
    outcomes.write_text("[]", encoding="utf-8")
    with pytest.raises(SystemExit):
        main(["--kinds", "clean", "--seed", "1", "--count", "1", "--json", str(outcomes)])
    assert "is there already" in capsys.readouterr().err
    assert outcomes.read_text(encoding="utf-8") == "[]"
