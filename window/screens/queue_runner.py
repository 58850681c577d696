"""Carries the queue out: one run after the other, each as soon as the stand is free."""

from collections.abc import Callable
from pathlib import Path
from typing import Final

from PySide6.QtCore import QObject, QTimer, Signal

from tumble.app.exits import JobError
from tumble.app.running import Job
from tumble.app.stand import LoadedStand
from tumble.app.stand_changes import check_unchanged
from tumble.procedures.errors import InputError
from tumble.window.look.language import tr
from tumble.window.look.sentences import held_text, unit_text
from tumble.window.screens.run_course import RunCourse, was_stopped
from tumble.window.work.activity import Activity, Calibration, Concluded, Resumption
from tumble.window.work.queue_file import QueueFile
from tumble.window.work.queued_run import asks_first, place_of, planned
from tumble.window.work.run_queue import AT_STAND, Entry, RunQueue, Stage

_WATCH_MS: Final = 1000
"""How often it is looked at what other windows have changed."""


class QueueRunner(QObject):
    """Begins what waits, follows it to its verdict, and keeps the queue in its store.

    A fault, a stop or a run that cannot begin holds the queue until somebody starts it again.

    Parameters
    ----------
    begin
        Begins a run at the stand; false where that is not possible now.
    stand
        That which is on screen.
    folder
        Store.
    """

    changed = Signal()
    """An entry, or whether the queue goes on."""
    unit_wanted = Signal(str)
    """Which unit is to be put on the stand before its run begins, as text; empty where none is wanted any more."""
    refused = Signal(object)
    """An exception that the person must see."""

    def __init__(
        self,
        begin: Callable[[Activity], bool],
        stand: Callable[[], LoadedStand],
        folder: Callable[[], Path],
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._begin_run, self._stand, self._folder = begin, stand, folder
        self._file = QueueFile(folder())
        self.going, self.said = False, ""
        """Whether it goes on by itself, and how it stands, in a sentence."""
        self._of: list[tuple[Activity, str]] = []
        """Runs that are under way, with the ids of their entries."""
        self._beginning: str | None = None
        self._wanted: str | None = None
        """Entry whose unit is awaited."""
        self._seated_entry: Entry | None = None
        """One whose unit is there, and that is begun next."""
        self._seated = ""
        """Serial number of the unit that was measured last."""
        self._watch = QTimer(self, interval=_WATCH_MS)
        self._watch.timeout.connect(self.look)

    @property
    def queue(self) -> RunQueue:
        """What is known of the queue of the store."""
        return self._file.queue

    def open(self) -> None:
        """Read what the store has kept, and go on looking at it: other windows of the store have a part in it."""
        self._hold("")
        self._file.leave()
        self._file, self._of = QueueFile(self._folder()), []
        self._file.sweep()
        self.look()
        self.changed.emit()
        self._watch.start()

    def look(self) -> None:
        """Show what other windows have changed."""
        try:
            changed = self._file.look()
        except (InputError, JobError) as error:
            self.refused.emit(error)
            return
        if self._wanted is not None and not self.queue.awaits_unit(self._wanted, self._file.owner):
            self.hold()
        elif changed:
            self.changed.emit()

    def leave(self) -> None:
        """Carry nothing out any more: what was under way here is stopped, and what was not begun waits on."""
        self._watch.stop()
        self._hold("")
        self._file.leave()

    def follow(self, course: RunCourse) -> None:
        """Hear what becomes of runs."""
        course.recorded.connect(self.hear_recorded)
        course.measured.connect(self.hear_measured)
        course.broke_off.connect(self.hear_failed)
        course.concluded.connect(self.hear_concluded)
        course.failed.connect(self.hear_failed)

    def add(self, job: Job, programme: str, repeats: int) -> None:
        """Add a run, as often as it is wanted; `programme` is its name or the path of its file."""
        entry = Entry(
            serial_number=job.serial_number,
            lot=job.lot,
            programme=programme,
            operator=job.operator,
            stand=place_of(job.stand),
        )
        runs = entry.repeated(repeats)
        self._update(lambda queue: queue.add(*runs))

    def move(self, entry_id: str, places: int) -> None:
        """Move an entry that waits."""
        self._update(lambda queue: queue.move(entry_id, places))

    def remove(self, entry_id: str) -> None:
        """Take an entry out that is not under way; one whose unit is awaited holds the queue."""
        if entry_id == self._wanted:
            self.hold()
        self._update(lambda queue: queue.remove(entry_id))

    def clear(self) -> None:
        """Take out everything that is not under way."""
        if self._wanted is not None:
            self.hold()
        self._update(RunQueue.clear)

    def start(self) -> None:
        """Go on by itself from now."""
        self.going, self.said = True, ""
        self.changed.emit()

    def hold(self) -> None:
        """Begin nothing more by itself."""
        self._hold(held_text())

    def proceed(self) -> None:
        """Begin the next run; to be called whenever the stand is free."""
        if not self.going or self._wanted is not None:
            return
        entry, self._seated_entry = self._seated_entry or self._claimed(), None
        if entry is None:
            return
        try:
            job, plan = planned(entry, self._stand())
        except InputError as error:
            self._fail(entry, str(error))
            self.refused.emit(error)
            return
        if self._seated not in ("", entry.serial_number) and not asks_first(plan):
            self._wanted = entry.id
            self._change(entry.id, lambda each: each.at(Stage.MOUNTING))
            self.unit_wanted.emit(unit_text(entry.serial_number, entry.lot))
        else:
            self._begin(entry, job)

    def confirm_unit(self) -> None:
        """The unit that was wanted is on the stand: its run begins as soon as that is told."""
        entry = self.queue.get(self._wanted)
        if entry is not None:
            self._seated, self._seated_entry, self._wanted = entry.serial_number, entry, None
            self.unit_wanted.emit("")

    def hear_begun(self, activity: Activity) -> None:
        """A run has the stand, begun from here or by the person."""
        entry_id = self._beginning
        if entry_id is None and isinstance(activity, Resumption):
            entry = self.queue.of_recording(str(activity.unfinished.path.resolve()))
            entry_id = entry.id if entry else None
        self._want_no_unit()
        self._seated = activity.job.serial_number
        self.said = held_text() if self.said and self.queue.waiting else ""  # why it was held may be of the past
        if entry_id is not None:
            self._of.append((activity, entry_id))
            self._file.be_present()
            self._change(entry_id, lambda each: each.begun(self._file.owner))

    def hear_waiting(self, waiting: bool) -> None:
        """Whether the run at the stand waits for the person."""
        stage = Stage.MOUNTING if waiting else Stage.MEASURING
        for _, entry_id in tuple(self._of):
            entry = self.queue.get(entry_id)
            if entry is not None and entry.stage in AT_STAND and entry.stage is not stage:
                self._change(entry.id, lambda each: each.at(stage))

    def hear_recorded(self, activity: Activity, path: Path) -> None:
        """Where a run was recorded."""
        self._change(self._id(activity), lambda each: each.recorded(path))

    def hear_measured(self, activity: Activity) -> None:
        """A run is over, and its analysis goes on beside."""
        self._change(self._id(activity), lambda each: each.at(Stage.ANALYSING))

    def hear_concluded(self, activity: Activity, concluded: Concluded) -> None:
        """A run has its record."""
        self._judge(self._forget(activity), concluded)

    def hear_failed(self, activity: Activity, error: BaseException) -> None:
        """A run, or its analysis, ended before its time."""
        entry = self.queue.get(self._forget(activity))
        if entry is None:
            self.hear_stop()
        elif was_stopped(error):
            self._change(entry.id, lambda each: each.at(Stage.STOPPED))
            self._hold(tr("The queue is held: {unit} was stopped. F4 goes on with the next.", unit=entry.serial_number))
        else:
            self._fail(entry, str(error))

    def hear_result(self, concluded: Concluded) -> None:
        """A run that was stopped, or whose analysis failed, was analysed after all."""
        for path in concluded.recordings:
            entry = self.queue.of_recording(str(path.resolve()))
            if entry is not None and entry.stage in (Stage.STOPPED, Stage.FAILED) and concluded.record_id:
                self._judge(entry.id, concluded)

    def hear_stop(self) -> None:
        """Everything is told to stop."""
        if self.going:
            self._hold(tr("The queue is held: it was stopped. F4 goes on with it."))

    def _claimed(self) -> Entry | None:
        """The entry to be carried out here, kept from every other window; None, and the queue held, without one."""
        try:
            check_unchanged(self._stand())
            entry = self._file.claim(place_of(self._stand()))
        except (InputError, JobError) as error:
            self._hold(held_text())
            self.refused.emit(error)
            return None
        if entry is None:
            elsewhere = tr("The queue is held: what waits was added for another stand. Choose that one, then F4.")
            self._hold(elsewhere if self.queue.waiting else tr("Everything in the queue was measured."))
        return entry

    def _begin(self, entry: Entry, job: Job) -> None:
        self._beginning = entry.id
        try:
            if not self._begin_run(Calibration(job=job, store=self._folder())):
                self._release(entry)
                self._hold(tr("The queue is held: the stand is at work. F4 goes on with it."))
        finally:
            self._beginning = None

    def _fail(self, entry: Entry, why: str) -> None:
        self._change(entry.id, lambda each: each.failed(why))
        unit = entry.serial_number
        self._hold(tr("The queue is held: {unit} failed, as its line says. F4 goes on with the next.", unit=unit))

    def _hold(self, said: str) -> None:
        self.going, self.said = False, said
        self._want_no_unit()
        self.changed.emit()

    def _want_no_unit(self) -> None:
        seated, self._seated_entry = self._seated_entry, None
        self._release(seated)
        if self._wanted is not None:
            entry, self._wanted = self.queue.get(self._wanted), None
            self._release(entry)
            self.unit_wanted.emit("")

    def _release(self, entry: Entry | None) -> None:
        """Have an entry wait again, for any window, unless something else became of it."""
        self._change(entry.id if entry else None, Entry.given_up)

    def _id(self, activity: Activity) -> str | None:
        return next((entry_id for each, entry_id in self._of if each is activity), None)

    def _forget(self, activity: Activity) -> str | None:
        entry_id = self._id(activity)
        self._of = [each for each in self._of if each[0] is not activity]
        return entry_id

    def _judge(self, entry_id: str | None, concluded: Concluded) -> None:
        self._change(entry_id, lambda each: each.judged(concluded.outcome, concluded.record_id))

    def _change(self, entry_id: str | None, change: Callable[[Entry], Entry]) -> None:
        if entry_id is not None:
            self._update(lambda queue: queue.change(entry_id, change))

    def _update(self, change: Callable[[RunQueue], None]) -> None:
        """Change the queue for every window, and have it shown."""
        try:
            self._file.update(change)
        except (InputError, JobError) as error:
            self.refused.emit(error)
        self.changed.emit()
