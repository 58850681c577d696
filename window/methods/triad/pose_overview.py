"""Where a run of a triad is: a picture of the position that is taken now, and the points so far."""

from collections.abc import Sequence

from PySide6.QtCore import QByteArray, Qt
from PySide6.QtSvgWidgets import QSvgWidget
from PySide6.QtWidgets import QVBoxLayout

from tumble.calibrations.methods.triad.pose_picture import pose_picture
from tumble.procedures.layout import Layout
from tumble.procedures.steps import Dwell, Point
from tumble.window.generic.point_table import PointTable
from tumble.window.look.language import tr
from tumble.window.look.numbers import local
from tumble.window.parts import Overview


class PosePicture(QSvgWidget):
    """A position of the stand, on white paper as in the report; nothing until one is shown."""

    def __init__(self) -> None:
        super().__init__()
        self.setMinimumHeight(170)
        self.setStyleSheet("background: #FFFFFF;")

    def show_pose(self, outer_deg: float, inner_deg: float) -> None:
        """Draw it, and say it to a screen reader."""
        self.load(QByteArray(pose_picture(outer_deg, inner_deg).encode()))
        self.renderer().setAspectRatioMode(Qt.AspectRatioMode.KeepAspectRatio)
        said = tr("outer {outer}°, inner {inner}°", outer=local(f"{outer_deg:g}"), inner=local(f"{inner_deg:g}"))
        self.setAccessibleName(said)
        self.setToolTip(said)


class PoseOverview(Overview):
    """The picture above the table of points."""

    def __init__(self, layout: Layout) -> None:
        super().__init__()
        self.picture, self.points = PosePicture(), PointTable(layout)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.picture, stretch=1)
        column.addWidget(self.points, stretch=2)

    @property
    def done(self) -> int:
        """Number of dwells that are done."""
        return self.points.done

    def show_plan(self, dwells: Sequence[Dwell], points: Sequence[Point] = ()) -> None:
        """Show the next position of a programme."""
        self.points.show_plan(dwells, points)
        if len(points) < len(dwells):
            self._show(dwells[len(points)])

    def begin(self, dwell: Dwell) -> None:
        """Show the position that is taken now."""
        self.points.begin(dwell)
        self._show(dwell)

    def complete(self, dwell: Dwell, point: Point) -> None:
        """List the point that came of it."""
        self.points.complete(dwell, point)

    def _show(self, dwell: Dwell) -> None:
        self.picture.show_pose(dwell.targets_deg["outer"], dwell.targets_deg["inner"])
