"""A plot of several series says how many points of each are drawn."""

import numpy as np

from tumble.window.widgets.series_plot import SeriesPlot


def test_a_series_without_a_point_yet_has_none_drawn(qapp):
    plot = SeriesPlot(["u"], "angle (°)", "voltage (V)")
    plot.draw_series({"u": (np.array([]), np.array([]))})
    assert plot.drawn("u") == 0
