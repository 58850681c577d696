"""Channels are shown in words with their units, and not by the names of columns."""

import pytest

from tumble.messages import Language
from tumble.procedures.methods.gyrocompass.layout import LAYOUT as PLATFORM
from tumble.procedures.methods.triad.layout import LAYOUT as TRIAD
from tumble.window.generic.channel_plots import ChannelPlots
from tumble.window.generic.point_table import PointTable
from tumble.window.look.channels import channel_text
from tumble.window.look.language import speak
from tumble.window.work.background import Background


@pytest.fixture
def german(qapp):
    speak(Language.GERMAN)
    yield
    speak(Language.ENGLISH)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("u_x_v", "u_x (V)"),
        ("levelling_rate_deg_h", "levelling rate (°/h)"),
        ("tilt_gamma_deg", "tilt γ (°)"),
        ("output_v", "output (V)"),
        ("wind_m_s", "wind_m_s"),
    ],
)
def test_a_channel_is_named_in_words_with_its_unit(qapp, name, text):
    assert channel_text(name) == text


def test_channels_and_axes_are_named_in_the_language(german):
    assert channel_text("levelling_rate_deg_h") == "Horizontierrate (°/h)"


def test_the_columns_of_points_have_units(qtbot, qapp):
    table = PointTable(TRIAD)
    qtbot.addWidget(table)
    headings = [table.table.horizontalHeaderItem(place).text() for place in range(7)]
    assert headings[2:] == ["Outer axis (°)", "Inner axis (°)", "u_x (V)", "u_y (V)", "u_z (V)"]


def test_a_plot_is_of_channels_of_one_unit(qtbot, qapp):
    plots = ChannelPlots(PLATFORM, Background())
    qtbot.addWidget(plots)
    assert list(plots.plots) == ["°/h", "°"]
    assert plots.plots["°/h"]._left == "mean (°/h)"
    assert plots.plots["°/h"].title_of("levelling_rate_deg_h") == "levelling rate"
