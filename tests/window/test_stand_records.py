import numpy as np
from head_tables import rests

from tumble.app.referencing import learn_from_reference
from tumble.calibrations.core.table import write_table

STAND = {"name": "bench-9", "head": {"driver": "simulated", "serial": "H-1"}, "daq": {"driver": "simulated"}}


def test_the_head_map_of_a_stand_record_is_drawn_with_its_band(driver, tmp_path):
    write_table(rests(lambda a, d, t: 0.02 * np.sin(np.deg2rad(a))), tmp_path / "head.csv")
    records = driver.window.records
    folder = records._folder()
    folder.mkdir(parents=True, exist_ok=True)
    learn_from_reference(tmp_path / "head.csv", STAND, folder)
    records.refresh()
    driver.wait(lambda: records.stands.choice.count() == 1)
    assert records.stands.choice.currentText() == "bench-9 1, in force"
    angle_deg, error_arcsec = records.stands.line.getData()
    assert abs(error_arcsec[np.argmin(np.abs(angle_deg - 90.0))] - 72.0) < 2.0
