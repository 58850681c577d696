"""What is shown of a triad that was taken to several temperatures."""

import numpy as np
import pytest
from triad_tables import made, read

from tumble.calibrations.methods.triad.over_temperature import temperature_section
from tumble.calibrations.report.figure import Marks


def at_temperatures(tmp_path, degc, programme="12o"):
    """A list of positions at each temperature; the bias of x rises by 20 µV/K."""
    parts = [made(programme, seed=seed) for seed, _ in enumerate(degc)]
    columns = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    columns["temperature_degC"] = np.repeat(np.array(degc, float), len(parts[0]["time_s"]))
    columns["time_s"] = 175.0 * np.arange(len(columns["time_s"]))
    columns["u_x_V"] = columns["u_x_V"] + 2e-5 * (columns["temperature_degC"] - 23.0)
    return read(tmp_path, columns)


def test_each_temperature_is_a_column(tmp_path):
    section = temperature_section(at_temperatures(tmp_path, [10, 35, 60]))

    assert section.headings == ("", "10.0 °C", "35.0 °C", "60.0 °C")
    assert len(section.rows) == 14


def test_the_figure_has_every_parameter_with_its_interval(tmp_path):
    figure = temperature_section(at_temperatures(tmp_path, [10, 35, 60])).figure()
    marks = {layer.label: layer for panel in figure.panels for layer in panel.layers if isinstance(layer, Marks)}

    assert len(marks) == 14
    assert marks["bias_x"].y == pytest.approx([-500.0, 0.0, 500.0], abs=60.0)
    assert all(each.y_ends[0][0] < each.y[0] < each.y_ends[1][0] for each in marks.values())


def test_one_temperature_has_no_section(tmp_path):
    assert temperature_section(at_temperatures(tmp_path, [23])).empty


def test_a_temperature_with_too_few_positions_has_none(tmp_path):
    rows = at_temperatures(tmp_path, [20, 40])

    assert temperature_section(rows.select(np.arange(24) < 15)).empty
