"""The tab that says what the uncertainties of an accelerometer are made of."""

import pytest
from PySide6.QtWidgets import QLabel

from tumble.app.analysing import fit, trace
from tumble.app.measurements import read_measurement
from tumble.window.registry import window_part
from tumble.window.work.activity import Concluded

STAND = {
    "name": "bench-1",
    "head": {"driver": "simulated", "limits_deg": [-180.0, 760.0], "accuracy_arcsec": 2.0},
    "daq": {"driver": "simulated", "gain_uncertainty": 3e-4},
    "simulated": {"preset": "DXL203EB"},
}
FLIPS = """\
angle_deg,voltage_V
-90,3.5
90,1.5
180,2.51
0,2.49
-90,3.5004
90,1.4998
180,2.5103
0,2.4901
"""


@pytest.fixture
def tab(qtbot, qapp, write):
    traced = trace(fit(read_measurement(write("flips.csv", FLIPS), STAND), trials=0))
    part = window_part("dividing_head")
    (budget,) = [each for each in part.tabs() if each.title == "Budget"]
    qtbot.addWidget(budget.widget)
    budget.show(part.present(Concluded(method="dividing_head", traced=traced, recordings=())))
    return budget.widget


def test_it_is_a_table_of_sources_by_parameters(tab):
    (table,) = tab.tables
    headings = [table.horizontalHeaderItem(column).text() for column in range(table.columnCount())]
    assert headings == ["Source", "Type", "Size", "ν", "u0 µV", "kx µV/g", "ky µV/g"]


def test_each_source_says_what_it_is_worth_for_each_parameter(tab):
    scatter, _, gain = tab.tables[0].texts()[:3]
    # 176 µV by the roots of the eight rows that see the bias, and of the four that see either sensitivity
    assert [*scatter] == ["scatter of the data", "A", "176 µV a dwell", "5", "62.2", "88.0", "88.0"]
    # 0.0003 of 2.5 V, 1 V/g and 10 mV/g
    assert [*gain] == ["DAQ gain", "B", "0.0003 relative", "∞", "750.0", "300.0", "3.0"]


def test_below_stands_what_the_sources_come_to(tab):
    combined = tab.tables[0].texts()[3]
    assert [*combined] == ["Combined u", "", "", "", "752.6", "312.7", "88.4"]  # roots of the sums of squares


def test_it_says_in_words_what_the_types_are(tab):
    assert any("Type A comes from the data, type B" in label.text() for label in tab.findChildren(QLabel))
