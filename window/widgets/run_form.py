"""What shall be measured: unit, programme, operator."""

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from PySide6.QtCore import QSettings, Qt, Signal
from PySide6.QtWidgets import QGridLayout, QLabel, QLineEdit, QPushButton, QWidget

from tumble.app.names import given_name
from tumble.app.running import Job
from tumble.app.stand import LoadedStand, load_stand
from tumble.app.stand_changes import check_unchanged
from tumble.procedures.errors import InputError
from tumble.procedures.programme import Programme
from tumble.procedures.programmes import about_programme, load_programme, shipped_programmes
from tumble.window.kept import kept_text
from tumble.window.look.alphabets import doubt
from tumble.window.look.language import tr
from tumble.window.look.plain import PlainLabel, as_tooltip
from tumble.window.look.sentences import in_language, plan_text
from tumble.window.widgets.dialog import FileDialog
from tumble.window.widgets.programme_box import ProgrammeBox
from tumble.window.widgets.scan_field import ScanField
from tumble.window.work.background import Background


class RunForm(QWidget):
    """Serial number and lot, typed or scanned; programme; operator.

    A scanner types and sends Enter, which goes to the serial number and selects it. Nothing here starts anything.
    """

    changed = Signal()
    method_chosen = Signal(str)
    """Of the programme; there is none where that cannot be read."""
    dialog_wanted = Signal(object)
    """`Dialog`."""

    def __init__(self, stand: Callable[[], LoadedStand], background: Background, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._stand = stand
        self.serial, self.lot, self.operator = ScanField(), ScanField(), QLineEdit()
        self.programme = ProgrammeBox(self._takes, _about, background)
        self.serial.setPlaceholderText(tr("type or scan"))
        for field in (self.serial, self.lot):
            field.returnPressed.connect(self.await_scan)
        for name in sorted(shipped_programmes(), key=_is_probe):
            self.programme.addItem(name, name)
        self.add_programme(kept_text("run/programme", "seed"))
        self.programme.setMinimumContentsLength(14)
        self.operator.setText(kept_text("run/operator"))
        self._browse = QPushButton(tr("&File…"))
        self._browse.clicked.connect(self._choose_file)
        self.summary = PlainLabel()
        self.summary.setWordWrap(True)
        self.doubted = PlainLabel()
        self.doubted.setWordWrap(True)
        self.doubted.hide()
        self._lay_out()
        self.serial.textChanged.connect(self.changed)
        self.serial.textChanged.connect(self._doubt)
        self.operator.editingFinished.connect(self._remember)
        self.operator.textChanged.connect(self.changed)
        self.programme.currentIndexChanged.connect(self._programme_chosen)

    def plan_anew(self) -> None:
        """Say what the programme takes on the stand that is chosen."""
        self.programme.forget()
        self._summarise()

    def add_programme(self, name_or_path: str) -> None:
        """Choose a programme, one that comes along or a file."""
        if self.programme.findData(name_or_path) < 0:
            path = Path(name_or_path)
            self.programme.addItem(str(Path(path.parent.name, path.name)), name_or_path)
            self.programme.setItemData(
                self.programme.count() - 1, as_tooltip(name_or_path), Qt.ItemDataRole.ToolTipRole
            )
        self.programme.setCurrentIndex(self.programme.findData(name_or_path))

    @property
    def chosen(self) -> str:
        """The programme that is chosen: the name of one that comes along, or the path of a file."""
        return str(self.programme.currentData())

    def await_scan(self) -> None:
        """Have the next serial number take the place of the one that is there."""
        self.serial.setFocus()
        self.serial.selectAll()

    def chosen_or_shipped(self) -> Programme:
        """The programme that is chosen, or the first that comes along where that cannot be read."""
        try:
            return load_programme(self.chosen)
        except InputError:
            return load_programme(shipped_programmes()[0])

    def job(self) -> Job:
        """What is asked for. Raises `InputError` where something is missing, or the stand cannot do it."""
        serial_number = self.serial.text().strip()
        if not serial_number:
            raise InputError(tr("There is no serial number yet: type it or scan it"))
        check_unchanged(self._stand())
        job = Job(
            stand=self._stand(),
            programme=load_programme(self.chosen),
            serial_number=given_name(serial_number, tr("serial number")),
            lot=given_name(self.lot.text(), tr("lot")),
            operator=given_name(self.operator.text(), tr("operator")),
        )
        job.plan()
        return job

    def _lay_out(self) -> None:
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        parts = (
            (tr("&Serial number"), self.serial, 3),
            (tr("Lo&t"), self.lot, 1),
            (tr("&Programme"), self.programme, 3),
            ("", self._browse, 0),
            (tr("&Operator"), self.operator, 2),
        )
        for column, (text, field, stretch) in enumerate(parts):
            label = QLabel(text)
            label.setBuddy(field)
            grid.addWidget(label, 0, column)
            grid.addWidget(field, 1, column)
            grid.setColumnStretch(column, stretch)
        grid.addWidget(self.doubted, 2, 0, 1, len(parts))

    def _choose_file(self) -> None:
        dialog = FileDialog(tr("Programme"), Path.cwd(), tr("Programmes (*.toml)"))
        dialog.chosen.connect(self._choose_anew)
        dialog.dismissed.connect(self.await_scan)
        self.dialog_wanted.emit(dialog)

    def _choose_anew(self, path: Path) -> None:
        """Choose a file, which may have been mended since it was chosen before."""
        self.programme.forget()
        self.add_programme(str(path))
        self._programme_chosen()

    def _programme_chosen(self) -> None:
        self._remember()
        with suppress(InputError):
            self.method_chosen.emit(load_programme(self.chosen).method)
        self._summarise()
        self.changed.emit()

    def _doubt(self, serial_number: str) -> None:
        """Say what is doubtful about the letters of a unit, whose record nobody would find again."""
        self.doubted.setText(doubt(serial_number))
        self.doubted.setVisible(bool(self.doubted.text()))

    def _remember(self) -> None:
        QSettings().setValue("run/programme", self.chosen)
        QSettings().setValue("run/operator", self.operator.text())

    def _summarise(self) -> None:
        try:
            planned = Job(stand=self._stand(), programme=load_programme(self.chosen), serial_number="").plan()
        except InputError as error:
            self.summary.setText(in_language(str(error)))
            return
        self.summary.setText(plan_text(planned))
        self.programme.setToolTip(as_tooltip(_about(self.chosen)))

    def _takes(self, name_or_path: str) -> str:
        """What a programme takes where it is run; empty where it cannot be."""
        try:
            programme, stand = load_programme(name_or_path), self._stand()
            chosen = stand if stand.path is not None else load_stand(None, programme.method)
            return plan_text(Job(stand=chosen, programme=programme, serial_number="").plan())
        except InputError:
            return ""


def _about(name_or_path: str) -> str:
    """What a programme says of itself, or why it cannot be read."""
    try:
        return in_language(about_programme(name_or_path))
    except InputError as error:
        return in_language(str(error))


def _is_probe(name: str) -> bool:
    """Whether a programme is one that the closed loop asks for: these come last."""
    return name.startswith("probe-")
