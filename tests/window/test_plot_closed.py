"""A plot that was closed is whole still: what is left of it once crashed the window where the size of text changed."""

from PySide6.QtGui import QFont

from tumble.window.look.plots import Plot


def test_a_plot_that_was_closed_takes_another_size_of_text(qapp):
    plot = Plot(bottom="angle (°)", left="output (V)")
    plot.show()
    plot.close()

    larger = QFont(plot.font())
    larger.setPointSizeF(2.0 * larger.pointSizeF())
    plot.setFont(larger)

    assert not plot.isVisible()
    assert plot.getAxis("bottom").labelText == "angle (°)"
    assert plot.getAxis("bottom").label.font().pointSizeF() == larger.pointSizeF()
