"""The screen Records: what was measured, compared, verified, written elsewhere, and what came to no end."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Final

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtWidgets import QPushButton, QTabWidget, QVBoxLayout, QWidget

from tumble.app.discarding import FOLDER
from tumble.calibrations.records.findings import words_of
from tumble.calibrations.records.record import Record
from tumble.procedures.errors import InputError
from tumble.window.look.language import tr
from tumble.window.look.plain import PlainLabel
from tumble.window.look.sentences import in_language
from tumble.window.screens.cut_off_view import CutOffView
from tumble.window.screens.exporting import Exporting
from tumble.window.screens.record_preview import RecordPreview
from tumble.window.screens.stand_records import StandRecords
from tumble.window.widgets.action_menu import ActionButton
from tumble.window.widgets.comparison_table import ComparisonTable
from tumble.window.widgets.dialog import FileDialog, QuestionDialog
from tumble.window.widgets.folding_row import FoldingRow, buttons_at_left, buttons_beside
from tumble.window.widgets.record_search import RecordSearch
from tumble.window.widgets.record_table import RecordTable
from tumble.window.widgets.side_pane import SidePane
from tumble.window.widgets.splitter import Splitter
from tumble.window.widgets.trend_plot import TrendPlot
from tumble.window.work import records as store
from tumble.window.work.activity import Resumption
from tumble.window.work.background import Background
from tumble.window.work.newest import Newest

if TYPE_CHECKING:
    from tumble.calibrations.records.verify import Verification
    from tumble.window.work.compared import Comparison
    from tumble.window.work.preview import Preview

_REST_MS: Final = 150
"""The trend is drawn once nobody has looked for others for so long: drawing keeps a key waiting."""


class RecordsScreen(QWidget):
    """Search, list, what one can do with a record; trend, runs that were cut off, and records of stands beside it."""

    opened = Signal(object)
    """`Concluded`."""
    resume_wanted = Signal(object, object)
    """`Resumption`, and the points that are there."""
    shown = Signal()
    """What was looked for is in the table."""
    found_cut_off = Signal(object)
    """Runs that came to no record, `CutOff` each, the newest last."""
    dialog_wanted = Signal(object)
    """`Dialog`."""
    refused = Signal(object)
    """An exception that the person must see."""

    def __init__(self, background: Background, folder: Callable[[], Path], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._background, self._folder, self._searches = background, folder, Newest(background)
        self.surveyor = Background(self)
        """Looks around in the store, which takes longer than a search and keeps none waiting."""
        self._rest = QTimer(self, interval=_REST_MS)
        self.records: tuple[Record, ...] = ()
        self.preview, self._previews, self.comparison = RecordPreview(), Newest(background), ComparisonTable()
        self.search, self.trend, self.cut_off, self.stands = RecordSearch(), TrendPlot(), CutOffView(), StandRecords()
        self.table = RecordTable()
        self.said, self.more = PlainLabel(), PlainLabel()
        self.more.hide()
        self.tabs = QTabWidget()
        self.open_button = ActionButton(self.table.offer(tr("&Open"), self._open))
        self.compare_button = ActionButton(self.table.offer(tr("&Compare two"), self._compare))
        self.verify_button = ActionButton(self.table.offer(tr("Ver&ify"), self._verify))
        self.again_button = ActionButton(self.table.offer(tr("&Analyse again"), self._analyse_again))
        self.export_button = ActionButton(self.table.offer(tr("&Export…"), self._choose_export))
        self.file_button = QPushButton(tr("From a &file…"))
        self._exporting = Exporting(self)
        self._lay_out()
        self._exporting.dialog_wanted.connect(self.dialog_wanted)
        self._exporting.wanted.connect(self.export_to)
        self.file_button.clicked.connect(self._choose_file)
        self.search.changed.connect(self.look)
        self.table.itemActivated.connect(lambda _: self._open())
        self.table.itemSelectionChanged.connect(self._show_chosen)
        self.cut_off.resume_wanted.connect(self.resume)
        self.cut_off.analysis_wanted.connect(self.analyse_cut_off)
        self.cut_off.discard_wanted.connect(self.discard)
        self._rest.setSingleShot(True)
        self._rest.timeout.connect(self._draw_trend)
        self.shown.connect(self._rest.start)
        self._refresh_buttons()

    def refresh(self) -> None:
        """Look again, for records and for everything else that is shown."""
        self.look()
        self.surveyor.start(partial(store.look_around, self._folder()), self._show_around, self._background.failed.emit)

    def look(self) -> None:
        """Look for the records that are wanted."""
        self._searches.start(partial(store.search, self._folder(), self.search.wanted()), self._show)

    def allow_runs(self, allowed: bool) -> None:
        """Whether the stand is free."""
        self.cut_off.allow_runs(allowed)

    def export_to(self, path: Path) -> None:
        """Write the record that is chosen, in the format of the file's name."""
        for record in self._chosen()[:1]:
            self._start(partial(store.export, self._folder(), record.id, path), self._say_exported)

    def _lay_out(self) -> None:
        of_records = (self.open_button, self.compare_button, self.verify_button)
        further = (self.again_button, self.export_button, self.file_button)
        buttons = FoldingRow((buttons_at_left(of_records), buttons_beside(further)))
        self.said.setWordWrap(True)
        self.said.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        listed = QWidget()
        column = QVBoxLayout(listed)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.table, stretch=1)
        column.addWidget(self.more)
        column.addWidget(buttons)
        column.addWidget(self.said)
        for part, title in (
            (self.trend, tr("Trend")),
            (self.cut_off, tr("Runs without a record")),
            (self.stands, tr("Stands")),
        ):
            self.tabs.addTab(part, title)
        layout = QVBoxLayout(self)
        layout.addWidget(self.search)
        parts = Splitter(Qt.Orientation.Vertical, (listed, self.tabs), (3, 2))
        layout.addWidget(SidePane(parts, self.tabs, self.preview, tr("In short")), stretch=1)

    def _show(self, found: store.Found) -> None:
        self.records = tuple(line.record for line in found.lines)
        self.table.show_lines(found.lines)
        self.more.setText(tr("The newest {count} are listed; look for fewer to see others.", count=len(self.records)))
        self.more.setVisible(found.more)
        self._refresh_buttons()
        self.shown.emit()

    def _show_chosen(self) -> None:
        """Say what can be done with what is chosen, and show it in short."""
        self._refresh_buttons()
        chosen = self._chosen()
        if len(chosen) == 1:
            self._previews.start(partial(store.preview, chosen[0]), partial(self._show_preview, chosen[0].id))
        else:
            self.preview.show_nothing()

    def _show_preview(self, record_id: str, preview: "Preview") -> None:
        """Show a record in short, if it is still the one that is chosen."""
        if [each.id for each in self._chosen()] == [record_id]:
            self.preview.show_preview(preview)

    def _draw_trend(self) -> None:
        self.trend.show_records(self.records)

    def _show_around(self, around: store.Around) -> None:
        self.search.programme.offer(around.programmes)
        self.search.stand.offer(around.stand_names)
        self.search.method.offer(around.methods, around.titles)
        self.search.finding.offer(around.findings, {name: words_of(name) for name in around.findings})
        self.cut_off.show_runs(around.cut_off, around.titles)
        self.found_cut_off.emit(around.cut_off)
        self.stands.show_records(around.stands)
        title = tr("Runs without a record")
        counted = f"{title} ({len(around.cut_off)})" if around.cut_off else title
        self.tabs.setTabText(self.tabs.indexOf(self.cut_off), counted)

    def _chosen(self) -> list[Record]:
        return self.table.chosen_records

    def _refresh_buttons(self) -> None:
        count = len(self.table.chosen)
        for button in (self.open_button, self.again_button, self.export_button):
            button.action.setEnabled(count == 1)
        self.compare_button.action.setEnabled(count == 2)
        self.verify_button.action.setEnabled(count > 0)

    def _start(self, function: Callable[[], object], done: Callable[..., None]) -> None:
        self.said.setText(tr("One moment…"))
        self._background.start(function, done, self._refuse)

    def _refuse(self, error: Exception) -> None:
        self.said.clear()
        self.refused.emit(error)

    def _open(self) -> None:
        for record in self._chosen()[:1]:
            self.open_record(record.id)

    def open_record(self, record_id: str) -> None:
        """Show a record on the screen Result."""
        self._start(partial(store.open_record, self._folder(), record_id), self._show_opened)

    def _analyse_again(self) -> None:
        for record in self._chosen()[:1]:
            self._start(partial(store.analyse_again, self._folder(), record.id), self._show_opened)

    def _show_opened(self, concluded: object) -> None:
        self.said.clear()
        self.opened.emit(concluded)

    def _compare(self) -> None:
        first, second = self._chosen()
        self._start(partial(store.comparison, first, second), self._show_comparison)

    def _show_comparison(self, found: "Comparison") -> None:
        self.said.setText(" ".join(found.unlike))
        self.comparison.show_comparison(found)
        if self.tabs.indexOf(self.comparison) < 0:
            self.tabs.insertTab(1, self.comparison, tr("Comparison"))
        self.tabs.setCurrentWidget(self.comparison)

    def _verify(self) -> None:
        ids = [record.id for record in self._chosen()]
        self._start(partial(store.verify_all, self._folder(), ids), self._say_verified)

    def _say_verified(self, found: "tuple[Verification, ...]") -> None:
        lines = []
        for one in found:
            if one.verified:
                lines.append(tr("✓ {id} is verified.", id=one.record_id))
            else:
                lines.extend([tr("✗ {id} does NOT verify:", id=one.record_id), *map(in_language, one.sentences)])
        self.said.setText("\n".join(lines))

    def _choose_export(self) -> None:
        for record in self._chosen()[:1]:
            self._exporting.ask(record.id, record.provenance.serial_number)

    def _choose_file(self) -> None:
        dialog = FileDialog(tr("Analyse a file"), Path.cwd(), tr("Recordings and tables (*.mcap *.csv)"))
        dialog.chosen.connect(self.analyse_file)
        self.dialog_wanted.emit(dialog)

    def analyse_file(self, path: Path) -> None:
        """Make a record of a recording or a table that lies anywhere."""
        self._start(partial(store.analyse_file, self._folder(), path), self._show_opened)

    def _say_exported(self, path: Path) -> None:
        self.said.setText(tr("Written: {path}", path=path))

    def analyse_cut_off(self, path: Path) -> None:
        """Make a record of what there is of a run that came to no end."""
        self._start(partial(store.analyse_cut_off, self._folder(), path), self._show_opened)

    def discard(self, path: Path) -> None:
        """Take a run out of the way once that is agreed to."""
        text = tr(
            "Discard the run {name}? It is not analysed and not offered again; its files are moved to the folder "
            "{folder} of the store, and not deleted.",
            name=path.name,
            folder=FOLDER,
        )
        question = QuestionDialog(tr("Discard"), text, tr("Discard it"))
        question.agreed.connect(lambda: self._start(partial(store.discard, self._folder(), path), self._say_discarded))
        self.dialog_wanted.emit(question)

    def _say_discarded(self, place: Path) -> None:
        self.said.setText(tr("Moved to {place}.", place=place))
        self.refresh()

    def resume(self, path: Path) -> None:
        """Find out what there is to go on with, and ask for that."""
        self._background.start(partial(store.resumption, self._folder(), path), self._begin, self.refused.emit)

    def _begin(self, resumption: Resumption) -> None:
        try:
            resumption.job.plan()
        except InputError as error:
            self.refused.emit(error)
            return
        self.resume_wanted.emit(resumption, resumption.unfinished.recording.points)
