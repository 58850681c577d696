"""Beginning a run: on the stand that is on screen, or on another one, which is asked first."""

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QObject, Signal

from tumble.app.stand import LoadedStand
from tumble.procedures.steps import Point
from tumble.window.look.language import tr
from tumble.window.screens.run import RunScreen
from tumble.window.screens.stand import StandScreen
from tumble.window.widgets.dialog import QuestionDialog
from tumble.window.work.activity import Activity, Resumption
from tumble.window.work.session import StandSession


class Beginning(QObject):
    """Has the screen Run begin what another screen asks for."""

    begun = Signal()
    resumed = Signal(object)
    """Path of the recording of a run that goes on: why it had broken off is of the past."""
    dialog_wanted = Signal(object)
    """`Dialog`."""

    def __init__(
        self,
        run: RunScreen,
        stand: StandScreen,
        session: Callable[[], StandSession],
        busy: Callable[[], bool],
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._run, self._stand, self._session, self._busy = run, stand, session, busy

    def begin(self, activity: Activity, points: tuple[Point, ...] = ()) -> None:
        """Begin a run; one of another stand than the one on screen asks for that first."""
        its, shown = activity.job.stand, self._session()
        if self._busy() or shown.is_of(its):
            self._begin_here(activity, points)
            return
        question = _question(its, shown.loaded)
        question.agreed.connect(partial(self._begin_there, activity, points))
        self.dialog_wanted.emit(question)

    def _begin_there(self, activity: Activity, points: tuple[Point, ...]) -> None:
        if self._stand.use(activity.job.stand):
            self._begin_here(activity, points)

    def _begin_here(self, activity: Activity, points: tuple[Point, ...]) -> None:
        if self._run.begin(activity, points):
            self.begun.emit()
            if isinstance(activity, Resumption):
                self.resumed.emit(activity.unfinished.path)


def _question(its: LoadedStand, shown: LoadedStand) -> QuestionDialog:
    text = tr(
        "This run was measured at the stand {its} ({path}); on screen is the stand {shown}. "
        "Leave that one, and go on with the run at {its}?",
        its=its.file.name,
        path=its.path or tr("the simulated stand that is built in"),
        shown=shown.file.name,
    )
    return QuestionDialog(tr("Another stand"), text, tr("Take the stand {its}, and go on", its=its.file.name))
