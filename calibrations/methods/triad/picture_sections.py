"""Pictures and tables by position: what a reader sees of a triad beside its values."""

from collections.abc import Iterator, Sequence

from tumble.calibrations.core.quantities import fixed
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.triad.figures import correlation_figure, mismatch_figure, mismatch_map
from tumble.calibrations.methods.triad.loop import TriadLoop
from tumble.calibrations.methods.triad.mismatch import PositionMismatch, position_mismatch
from tumble.calibrations.methods.triad.pose_picture import MOST, pose_pictures
from tumble.calibrations.tracing.loop_sections import beside_each_other
from tumble.messages import Message


def picture_sections(loop: TriadLoop) -> Iterator[Section]:
    """Mismatch over the poses, mismatch by dwell and by position, correlation, and the positions themselves."""
    found = position_mismatch(loop)
    yield Section(
        title=Message("Mismatch over the poses"),
        figure=lambda: mismatch_map(loop),
        caption=Message(
            "|a| - 1 of each position, mean of its dwells, by the vector fit; a turn of the unit against the stand "
            "does not show in it."
        ),
    )
    headings, rows = beside_each_other(("", Message("outer"), Message("inner"), Message("dwells")), _rows(found))
    yield Section(
        title=Message("Mismatch by position"),
        figure=lambda: mismatch_figure(loop),
        caption=Message("|a| - 1 of each dwell, before (circles) and with what was found (triangles)."),
        headings=headings,
        rows=rows,
    )
    yield Section(
        title=Message("Correlation"),
        figure=lambda: correlation_figure(loop),
        caption=Message("Of the parameters that these positions tell, with what was found."),
    )
    yield position_section(list(zip(found.outer_deg.tolist(), found.inner_deg.tolist(), strict=True)))


def position_section(positions: Sequence[tuple[float, float]]) -> Section:
    """Positions drawn, by their outer and inner angles in degrees."""
    return Section(
        title=Message("Positions"),
        figure=lambda: pose_pictures(positions),
        caption=Message(
            "In the order in which they are first taken, {most} at most: outer and inner angle. The dashed line is "
            "the outer axis, the mark on the table the zero of the inner one.",
            most=MOST,
        ),
    )


def _rows(found: PositionMismatch) -> list[tuple[str, ...]]:
    columns = (found.outer_deg, found.inner_deg, found.dwells, found.before_arcsec, found.after_arcsec)
    return [
        (str(number), f"{outer:g}°", f"{inner:g}°", str(dwells), f"{fixed(before, 2)}″", f"{fixed(after, 2)}″")
        for number, (outer, inner, dwells, before, after) in enumerate(
            zip(*(column.tolist() for column in columns), strict=True), start=1
        )
    ]
