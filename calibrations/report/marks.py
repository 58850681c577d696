"""What a layer of a figure is as SVG.

Absolute coordinates are data, relative ones are shape: `M12 34m-2-2h4v4h-4z`. So the script of the page zooms by moving
the absolute ones alone, and a mark keeps its size.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from html import escape
from typing import Final, TypeAlias

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.report.language import say
from tumble.calibrations.report.layers import INK, Area, Boxes, Cells, Layer, Line, Marks, Shades, Shape, Span
from tumble.calibrations.report.thinning import seen_line, seen_marks

Place: TypeAlias = Callable[[FloatArray], FloatArray]
"""From numbers of an axis to units of the page."""
_UNIT: Final = 1.3
"""Units of the page in a point: a figure is 720 wide."""
_BLUE, _WHITE, _RED = (np.array(each, dtype=float) for each in ((0, 114, 178), (255, 255, 255), (213, 94, 0)))


def marked(layer: Layer, x: Place, y: Place, width: float) -> str:
    """A layer in a panel of this width, as elements of SVG."""
    return "".join(_elements(layer, x, y, width))


def _elements(layer: Layer, x: Place, y: Place, width: float) -> Iterator[str]:
    match layer:
        case Marks():
            yield _marks(layer, x, y)
        case Line():
            dashes = ' stroke-dasharray="6 4"' if layer.dashed else ""
            across, up = x(layer.x), y(layer.y)
            seen = seen_line(across, up)
            yield _stroke(_polyline(across[seen], up[seen]), layer.colour, layer.width, dashes)
        case Area():
            around = np.concatenate([layer.x, layer.x[::-1]]), np.concatenate([layer.high, layer.low[::-1]])
            yield _fill(f"{_polyline(x(around[0]), y(around[1]))}z", layer.colour, layer.opacity)
        case Span():
            yield _span(layer, y, width)
        case Boxes():
            yield from _boxes(layer, x, y)
        case Cells():
            yield from _cells(layer, x, y)
        case Shades():
            yield from _shades(layer, x, y)


def sample(layer: Marks | Line, x: float, y: float) -> str:
    """What stands before the label of a layer in the legend, 18 wide."""
    if isinstance(layer, Line):
        return _stroke(f"M{x:g} {y:g}h18", layer.colour, layer.width)
    return _symbols(layer, np.array([x + 9.0]), np.array([y]), max(layer.size, 4.0))


def shade(value: float) -> str:
    """Colour of a number from -1 to 1."""
    part, end = min(abs(value), 1.0), _RED if value > 0 else _BLUE
    return "#{:02x}{:02x}{:02x}".format(*np.round(_WHITE + part * (end - _WHITE)).astype(int).tolist())


def _marks(layer: Marks, x: Place, y: Place) -> str:
    across, up = x(layer.x), y(layer.y)
    bars = ""
    if layer.y_ends is not None:
        bars += "".join(_segments(across, y(layer.y_ends[0]), across, y(layer.y_ends[1])))
    if layer.x_ends is not None:
        bars += "".join(_segments(x(layer.x_ends[0]), up, x(layer.x_ends[1]), up))
    return (_stroke(bars, layer.colour, layer.bar) if bars else "") + _symbols(layer, across, up, layer.size)


def _symbols(layer: Marks, across: FloatArray, up: FloatArray, size: float) -> str:
    if not size:
        return ""
    seen = seen_marks(across, up)
    points = zip(across[seen].tolist(), up[seen].tolist(), strict=True)
    opacity = "" if layer.opacity == 1.0 else f' opacity="{layer.opacity:g}"'
    if layer.shape in ("circle", "dot") and not layer.hollow:
        drawn = "".join(f"M{_n(px)} {_n(py)}h.01" for px, py in points)
        return (
            f'<path class="marks" d="{drawn}" fill="none" stroke="{layer.colour}" stroke-linecap="round" '
            f'stroke-width="{size * _UNIT:.3g}"{opacity}/>'
        )
    shape = _shape(layer.shape, size * _UNIT / 2.0)
    drawn = "".join(f"M{_n(px)} {_n(py)}{shape}" for px, py in points)
    fill, stroke = ("#fff", layer.colour) if layer.hollow or layer.shape == "cross" else (layer.colour, "none")
    return f'<path class="marks" d="{drawn}" fill="{fill}" stroke="{stroke}"{opacity}/>'


def _shape(shape: Shape, half: float) -> str:
    """Around a point, in relative coordinates."""
    r = f"{half:.3g}"
    d = f"{2 * half:.3g}"
    return {
        "circle": f"m-{r} 0a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0-{d} 0z",
        "dot": f"m-{r} 0a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0-{d} 0z",
        "square": f"m-{r}-{r}h{d}v{d}h-{d}z",
        "triangle": f"m-{r} {r}l{r}-{d}l{r} {d}z",
        "down": f"m-{r}-{r}l{r} {d}l{r}-{d}z",
        "diamond": f"m-{r} 0l{r}-{r}l{r} {r}l-{r} {r}z",
        "cross": f"m-{r}-{r}l{d} {d}m-{d} 0l{d}-{d}",
    }[shape]


def _span(layer: Span, y: Place, width: float) -> str:
    low, high = y(np.array([layer.low, layer.high])).tolist()
    if low == high:
        return _stroke(f"M0 {_n(low)}L{_n(width)} {_n(low)}", layer.colour, 0.7, ' class="whole"')
    return _fill(
        f"M0 {_n(low)}L{_n(width)} {_n(low)}L{_n(width)} {_n(high)}L0 {_n(high)}z", layer.colour, layer.opacity, "whole"
    )


def _boxes(layer: Boxes, x: Place, y: Place) -> Iterator[str]:
    for number, values in enumerate(layer.groups):
        low, middle, high = np.percentile(values, [25, 50, 75])
        reach = 1.5 * (high - low)
        inside = values[(values >= low - reach) & (values <= high + reach)]
        left, centre, right = x(np.array([number - 0.28, number, number + 0.28])).tolist()
        q1, q2, q3, least, most = y(np.array([low, middle, high, inside.min(), inside.max()])).tolist()
        corners = np.array([left, right, right, left]), np.array([q1, q1, q3, q3])
        whiskers = [*_segments([centre], [q3], [centre], [most]), *_segments([centre], [q1], [centre], [least])]
        yield _stroke("".join(whiskers), layer.colour, 0.9)
        yield f'<path d="{_polyline(*corners)}z" fill="#fff" stroke="{layer.colour}"/>'
        yield _stroke(f"M{_n(left)} {_n(q2)}L{_n(right)} {_n(q2)}", "#D55E00", 1.6)
        beyond = values[(values < low - reach) | (values > high + reach)]
        yield _marks(Marks(x=np.full(len(beyond), float(number)), y=beyond, colour=INK, size=2.0), x, y)


def _cells(layer: Cells, x: Place, y: Place) -> Iterator[str]:
    rows, columns = layer.values.shape
    for row in range(rows):
        for column in range(columns):
            value = float(layer.values[row, column])
            left, right = x(np.array([column - 0.5, column + 0.5])).tolist()
            top, foot = y(np.array([row - 0.5, row + 0.5])).tolist()
            if np.isfinite(value):
                around = np.array([left, right, right, left]), np.array([top, top, foot, foot])
                yield f'<path d="{_polyline(*around)}z" fill="{shade(value)}" stroke="#fff" stroke-width="1"/>'
            if layer.texts and layer.texts[row][column]:
                ink = "#fff" if abs(value) > 0.75 else INK
                yield (
                    f'<text x="{_n((left + right) / 2)}" y="{_n((top + foot) / 2 + 3.5)}" font-size="10" fill="{ink}" '
                    f'text-anchor="middle">{escape(say(layer.texts[row][column]))}</text>'
                )


def _shades(layer: Shades, x: Place, y: Place) -> Iterator[str]:
    for px, py, value in zip(x(layer.x), y(layer.y), layer.values.tolist(), strict=True):
        yield (
            f'<path class="marks" d="M{_n(px)} {_n(py)}{_shape("circle", 7.0)}" fill="{shade(value / layer.most)}" '
            f'stroke="{INK}" stroke-width="0.6"/>'
        )


def _segments(x1: Iterable[float], y1: Iterable[float], x2: Iterable[float], y2: Iterable[float]) -> Iterator[str]:
    for ends in zip(x1, y1, x2, y2, strict=True):
        if np.isfinite(ends).all():
            yield "M{} {}L{} {}".format(*map(_n, ends))


def _polyline(across: Sequence[float] | FloatArray, up: Sequence[float] | FloatArray) -> str:
    """A line that begins anew after every point that is none."""
    drawn, pen = [], "M"
    for px, py in zip(across, up, strict=True):
        if not (np.isfinite(px) and np.isfinite(py)):
            pen = "M"
            continue
        drawn.append(f"{pen}{_n(px)} {_n(py)}")
        pen = "L"
    return "".join(drawn)


def _stroke(path: str, colour: str, width: float, more: str = "") -> str:
    return (
        f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="{width * _UNIT:.3g}" '
        f'stroke-linejoin="round"{more}/>'
    )


def _fill(path: str, colour: str, opacity: float, name: str = "") -> str:
    named = f' class="{name}"' if name else ""
    return f'<path{named} d="{path}" fill="{colour}" fill-opacity="{opacity:g}"/>'


def _n(number: float) -> str:
    """To a hundredth, which is finer than a printer."""
    return f"{number:.2f}".rstrip("0").rstrip(".")
