"""The texts of a figure in the language of the page: labels that are messages, and numbers along the axes."""

from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.ticker import Formatter

from tumble.calibrations.report.language import say


class _Localised(Formatter):
    """Numbers along an axis as another formatter gives them, as the language writes them."""

    def __init__(self, inner: Formatter) -> None:
        self._inner = inner

    def set_locs(self, locs: list[float]) -> None:
        """Take the places of all numbers, on which their digits depend."""
        self._inner.set_locs(locs)

    def get_offset(self) -> str:
        """What stands once at the end of the axis."""
        return say(self._inner.get_offset())

    def __call__(self, x: float, pos: int | None = None) -> str:
        return say(self._inner(x, pos))


def put_into_words(figure: Figure) -> None:
    """Put every text of a figure into the language of the page."""
    for text in figure.findobj(Text):
        assert isinstance(text, Text), "none but texts were asked for"
        text.set_text(say(text.get_text()))
    for panel in figure.axes:
        for axis in (panel.xaxis, panel.yaxis):
            inner = axis.get_major_formatter()
            if not isinstance(inner, _Localised):  # panels that share a scale share it
                axis.set_major_formatter(_Localised(inner))
