"""Rows of a vibration table that are set aside."""

import pytest

from tumble.calibrations.methods.vibration.observations import read_vibration_table


@pytest.mark.parametrize("column", ["ai_g", "mii_g2"])
def test_what_no_exciter_reaches_is_set_aside_with_its_reason(tmp_path, column):
    path = tmp_path / "table.csv"
    path.write_text(f"output_ug,{column}\n100,1\n120,1e200\n110,2\n")

    rows = read_vibration_table(path)

    assert [str(each.reason) for each in rows.set_aside] == [f"{column} is 1e+200, beyond any shaker or centrifuge"]
