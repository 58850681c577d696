"""The steps of a programme, and how far a run is in them."""

from collections.abc import Callable, Sequence

from PySide6.QtCore import QAbstractListModel, QModelIndex, QPersistentModelIndex, Qt
from PySide6.QtWidgets import QAbstractItemView, QListView, QWidget

from tumble.procedures.plan import PlannedStep
from tumble.procedures.steps import Dwell, Step, pose
from tumble.window.look.language import tr
from tumble.window.look.names import in_words
from tumble.window.look.numbers import local, minutes
from tumble.window.look.sentences import in_language

_NOWHERE = QModelIndex()


class _Steps(QAbstractListModel):
    """Texts are made of the steps that are in sight, however many there are."""

    def __init__(self) -> None:
        super().__init__()
        self.steps: Sequence[PlannedStep] = ()
        self.now = 0
        """Number of the step that is taken, from 0; those before it are done."""

    def rowCount(self, parent: QModelIndex | QPersistentModelIndex = _NOWHERE) -> int:  # noqa: N802  # Qt's name
        return 0 if parent.isValid() else len(self.steps)

    def data(self, index: QModelIndex | QPersistentModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> str | None:
        if role != Qt.ItemDataRole.DisplayRole:
            return None
        row = index.row()
        sign = "✓" if row < self.now else "▶" if row == self.now else "·"
        return f"{sign} {row + 1}  {_words(self.steps[row].step)}  ({minutes(self.steps[row].duration_s)})"


class StepList(QListView):
    """Every step with its time, the one that is taken now in the middle."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._model = _Steps()
        self.setModel(self._model)
        self.setUniformItemSizes(True)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setAccessibleName(tr("Steps of the run"))

    @property
    def now(self) -> int:
        """Number of the step that is taken, from 0."""
        return self._model.now

    def show_steps(self, steps: Sequence[PlannedStep], points: int = 0) -> None:
        """Show another programme, of which so many points are there."""
        self._model.beginResetModel()
        self._model.steps = steps
        self._model.now = _after(steps, points)
        self._model.endResetModel()
        self._show_now()

    def begin(self, step: Step) -> None:
        """Mark a step as the one that is taken now; one that is taken again is left where it is."""
        self._go_to(lambda planned: planned.step == step)

    def complete(self) -> None:
        """Mark the dwell that is taken as done."""
        self._mark(min(self._model.now + 1, len(self._model.steps)))

    def texts(self) -> list[str]:
        """What the lines say."""
        return [str(self._model.index(row).data()) for row in range(self._model.rowCount())]

    def _go_to(self, wanted: Callable[[PlannedStep], bool]) -> None:
        ahead = range(self._model.now, len(self._model.steps))
        self._mark(next((row for row in ahead if wanted(self._model.steps[row])), self._model.now))

    def _mark(self, row: int) -> None:
        before, self._model.now = self._model.now, row
        self._model.dataChanged.emit(self._model.index(before), self._model.index(row))
        self._show_now()

    def _show_now(self) -> None:
        if self.isVisible():
            self.scrollTo(self._model.index(self._model.now), QAbstractItemView.ScrollHint.PositionAtCenter)


def _after(steps: Sequence[PlannedStep], points: int) -> int:
    """Number of the step after so many points."""
    ends = [row for row, planned in enumerate(steps, start=1) if isinstance(planned.step, Dwell)]
    return ends[points - 1] if points else 0


def _words(step: Step) -> str:
    if isinstance(step, Dwell):
        named = {condition: in_words(value) for condition, value in step.conditions.items()}
        return local(in_language(pose(named, step.targets_deg, "°")))
    return in_language(step.task)
