"""Pictures of a unit on a two-axis stand, drawn from the same geometry that the analysis uses, as SVG.

One is drawn in a fraction of a millisecond and needs no other library: the operator's window, the plan and the report
show the same.
"""

from collections.abc import Sequence
from html import escape
from typing import Final

import numpy as np
from markupsafe import Markup

from tumble.calibrations.core.arrays import FloatArray
from tumble.messages import Message

_TOWARDS: Final = np.array([0.35, -0.83, 0.43]) / np.linalg.norm([0.35, -0.83, 0.43])
"""To the reader, in the ground frame: X along the outer axis, Z up."""
_RIGHT: Final = np.array([0.83, 0.35, 0.0]) / np.hypot(0.83, 0.35)
_UP: Final = np.cross(_TOWARDS, _RIGHT)
_HALF_SIZES: Final = (0.62, 0.42, 0.16)
"""Of the unit along its axes: a flat box whose axes cannot be taken for each other."""
_TABLE: Final = 0.85
_SHADES: Final = (("#B9CBDE", "#A9BBCE"), ("#ABC0D6", "#9BB0C8"), ("#D3DFEB", "#C3CFDD"))
"""Of the faces across x, y, z: towards + and -."""
_AXIS_COLOURS: Final = ("#B34A00", "#00694D", "#00639C")
_INK: Final = "#222222"
_PALE: Final = "#5B6573"
_PAPER: Final = "#FFFFFF"
_CASING: Final = 0.045
"""Of paper on either side of an arrow and a letter, by which they stand out from what they lie on."""
_WIDTH: Final = 3.4
_HEIGHT: Final = 3.1
_IN_ROW: Final = 8
_PAGE_MM: Final = 174.0
"""Of what stands on a page."""
MOST: Final = 48
"""So many are drawn at once."""


def case_axes(outer_deg: float, inner_deg: float) -> FloatArray:
    """Axes x, y, z of the case in the ground frame, one a row, shape (3, 3): Rx(outer) Rz(inner)."""
    a, b = np.deg2rad(outer_deg), np.deg2rad(inner_deg)
    outer = np.array([[1.0, 0.0, 0.0], [0.0, np.cos(a), -np.sin(a)], [0.0, np.sin(a), np.cos(a)]])
    inner = np.array([[np.cos(b), -np.sin(b), 0.0], [np.sin(b), np.cos(b), 0.0], [0.0, 0.0, 1.0]])
    return np.asarray((outer @ inner).T)


def pose_picture(outer_deg: float, inner_deg: float) -> Markup:
    """One position: the outer axis, the table of the inner one with its zero mark, the unit, its axes, and gravity."""
    title = Message("outer {outer:g}°, inner {inner:g}°", outer=outer_deg, inner=inner_deg)
    return Markup(
        f'<svg xmlns="http://www.w3.org/2000/svg" role="img" aria-label="{escape(title)}" '
        f'viewBox="{-_WIDTH / 2:g} {-_HEIGHT / 2:g} {_WIDTH:g} {_HEIGHT:g}">{_drawn(outer_deg, inner_deg)}</svg>'
    )


def pose_pictures(positions: Sequence[tuple[float, float]]) -> Markup:
    """Positions in their order, eight in a row, each with its number and angles; `MOST` of them at most."""
    shown = positions[:MOST]
    rows = -(-len(shown) // _IN_ROW)
    height = _HEIGHT + 0.5
    parts = []
    for number, (outer_deg, inner_deg) in enumerate(shown):
        x, y = (number % _IN_ROW + 0.5) * _WIDTH, (number // _IN_ROW) * height + _HEIGHT / 2
        caption = f"{number + 1}: {outer_deg:g}°, {inner_deg:g}°"
        parts.append(
            f'<g transform="translate({x:g} {y:g})">{_drawn(outer_deg, inner_deg)}'
            f"{_text((0.0, _HEIGHT / 2 + 0.15), caption, _INK, 0.3)}</g>"
        )
    title = Message("Pictures of the positions")
    wide, high = _IN_ROW * _WIDTH, rows * height
    return Markup(
        f'<svg xmlns="http://www.w3.org/2000/svg" role="img" aria-label="{escape(title)}" '
        f'width="{_PAGE_MM:g}mm" height="{high / wide * _PAGE_MM:.1f}mm" style="max-width:100%;height:auto" '
        f'viewBox="0 0 {wide:g} {high:g}">{"".join(parts)}</svg>'
    )


def _drawn(outer_deg: float, inner_deg: float) -> str:
    """What is farther away first."""
    case, arm = case_axes(outer_deg, inner_deg), case_axes(outer_deg, 0.0)
    hidden = [axis for axis in range(3) if case[axis] @ _TOWARDS < 0.0]
    seen = [axis for axis in range(3) if axis not in hidden]
    table = [_table(arm)]
    unit: list[str] = [_arrows(case, hidden), *_faces(case), _arrows(case, seen)]
    near_first = arm[2] @ _TOWARDS > 0.0
    return "".join([_outer_axis(), *(table + unit if near_first else unit + table), _gravity()])


def _outer_axis() -> str:
    left, right = (_flat(np.array([x, 0.0, 0.0])) for x in (-1.55, 1.55))
    return _line(left, right, _PALE, 0.05, dash="0.12 0.08")


def _table(arm: FloatArray) -> str:
    """The disc under the unit; its mark is the zero of the inner axis."""
    turn = np.linspace(0.0, 2.0 * np.pi, 49)
    seat = -_HALF_SIZES[2] * arm[2]
    rim = seat + _TABLE * (np.outer(np.cos(turn), arm[0]) + np.outer(np.sin(turn), arm[1]))
    inside, edge = (_flat(seat + part * arm[0]) for part in (0.72, _TABLE))
    return _polygon(rim, "#F1F3F6", _PALE, opacity=0.75) + _line(inside, edge, _INK, 0.06)


def _faces(case: FloatArray) -> list[str]:
    return [_face(case, axis, sign) for axis in range(3) for sign in (1.0, -1.0) if sign * case[axis] @ _TOWARDS > 1e-9]


def _face(case: FloatArray, axis: int, sign: float) -> str:
    across, along = (other for other in range(3) if other != axis)
    middle = sign * case[axis] * _HALF_SIZES[axis]
    a, b = case[across] * _HALF_SIZES[across], case[along] * _HALF_SIZES[along]
    corners = np.array([middle + a + b, middle - a + b, middle - a - b, middle + a - b])
    drawn = _polygon(corners, _SHADES[axis][sign < 0.0], _INK)
    if axis == 2 and sign > 0.0:  # the mark that a package carries on its lid
        x, y = _flat(corners[0] * 0.75 + corners[2] * 0.25)
        drawn += f'<circle cx="{x:.3f}" cy="{y:.3f}" r="0.07" fill="{_PAPER}" stroke="{_INK}" stroke-width="0.03"/>'
    return drawn


def _arrows(case: FloatArray, axes: Sequence[int]) -> str:
    return "".join(
        _line((0.0, 0.0), _flat(1.05 * case[axis]), _PAPER, 0.05 + 2 * _CASING)
        + _line((0.0, 0.0), _flat(1.05 * case[axis]), _AXIS_COLOURS[axis], 0.05)
        + _letter(_flat(1.25 * case[axis]), "xyz"[axis], _AXIS_COLOURS[axis])
        for axis in axes
    )


def _gravity() -> str:
    x, top, foot = 1.5, -0.2, 0.5
    head = f"{x - 0.08:g},{foot - 0.02:g} {x + 0.08:g},{foot - 0.02:g} {x:g},{foot + 0.18:g}"
    return (
        _line((x, top), (x, foot), _INK, 0.05)
        + f'<polygon points="{head}" fill="{_INK}"/>'
        + _text((x, 0.95), "g", _INK, 0.28)
    )


def _flat(point: FloatArray) -> tuple[float, float]:
    """On the paper, y down."""
    return float(point @ _RIGHT), -float(point @ _UP)


def _line(begin: tuple[float, float], end: tuple[float, float], colour: str, width: float, dash: str = "") -> str:
    dashed = f' stroke-dasharray="{dash}"' if dash else ""
    return (
        f'<line x1="{begin[0]:.3f}" y1="{begin[1]:.3f}" x2="{end[0]:.3f}" y2="{end[1]:.3f}" stroke="{colour}" '
        f'stroke-width="{width:g}" stroke-linecap="round"{dashed}/>'
    )


def _polygon(points: FloatArray, fill: str, stroke: str, opacity: float = 1.0) -> str:
    corners = " ".join("{:.3f},{:.3f}".format(*_flat(point)) for point in points)
    return (
        f'<polygon points="{corners}" fill="{fill}" fill-opacity="{opacity:g}" stroke="{stroke}" stroke-width="0.03"/>'
    )


def _letter(place: tuple[float, float], letter: str, colour: str) -> str:
    """The letter of an axis, on a casing of its own."""
    casing = f'stroke="{_PAPER}" stroke-width="{200 * _CASING:g}" stroke-linejoin="round"'
    return _text(place, letter, _PAPER, 0.3, casing) + _text(place, letter, colour, 0.3)


def _text(place: tuple[float, float], text: str, colour: str, size: float, outline: str = "") -> str:
    """A text whose middle is at a place on the paper, y down."""
    x, y = place
    return (  # Qt takes whole sizes of letters alone
        f'<text transform="translate({x:.3f} {y + size / 3:.3f}) scale(0.01)" font-size="{100 * size:.0f}" '
        f'font-family="sans-serif" fill="{colour}" {outline} text-anchor="middle">{escape(text)}</text>'
    )
