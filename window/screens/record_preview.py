"""The record that is chosen, in short."""

from collections.abc import Sequence

from PySide6.QtCore import QEvent, Qt
from PySide6.QtWidgets import QHBoxLayout, QLabel, QScrollArea, QVBoxLayout, QWidget

from tumble.window.look.language import tr
from tumble.window.look.plain import PlainLabel
from tumble.window.look.signs import sign_icon
from tumble.window.look.theme import colours
from tumble.window.look.verdicts import VERDICT_SIGNS, verdict_words
from tumble.window.widgets.table import Table
from tumble.window.work.preview import Preview

_NARROW_LINES = 25
"""Width that it asks for, in lines of text."""


class RecordPreview(QScrollArea):
    """Verdict, the values to use, effects and stand; a sentence where not one record is chosen."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.shown: Preview | None = None
        self.unit, self._subject, self.verdict = PlainLabel(), PlainLabel(), PlainLabel()
        self._sign = QLabel()
        self.values = Table((tr("parameter"), tr("Value ± U"), tr("verdict, condition")))
        self.effects, self.stand, self.warnings = PlainLabel(), PlainLabel(), PlainLabel()
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._lay_out()
        self.show_nothing()

    def show_nothing(self) -> None:
        """Say that one record is to be chosen."""
        self.shown = None
        self.unit.setText(tr("Choose a record to see it in short."))
        for part in self._parts:
            part.hide()

    def show_preview(self, shown: Preview) -> None:
        """Show another record."""
        self.shown = shown
        self.unit.setText(shown.unit)
        self._subject.setText(shown.subject)
        self.verdict.setText(verdict_words(shown.outcome))
        self.values.fill(shown.values)
        self.values.setColumnHidden(2, not any(beside for *_, beside in shown.values))
        self.values.show_whole()
        self.effects.setText(_listed(tr("Effects"), shown.findings))
        self.stand.setText(_listed(tr("Stand"), [shown.stand] if shown.stand else []))
        self.warnings.setText(f"⚠ {shown.warnings}" if shown.warnings else "")
        for part in self._parts:
            part.show()
        for label in (self.stand, self.warnings):
            label.setVisible(bool(label.text()))
        self._paint_sign()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802  # Qt's name
        """Take over another palette or size of text."""
        super().changeEvent(event)
        if event.type() in (QEvent.Type.PaletteChange, QEvent.Type.FontChange):
            self._size()
            self._paint_sign()

    @property
    def _parts(self) -> tuple[QWidget, ...]:
        return self._subject, self._sign, self.verdict, self.values, self.effects, self.stand, self.warnings

    def _lay_out(self) -> None:
        self.unit.setObjectName("heading")
        content, verdict = QWidget(), QHBoxLayout()
        verdict.addWidget(self._sign)
        verdict.addWidget(self.verdict, stretch=1)
        column = QVBoxLayout(content)
        column.addWidget(self.unit)
        column.addWidget(self._subject)
        column.addLayout(verdict)
        for part in (self.values, self.effects, self.stand, self.warnings):
            column.addWidget(part)
        column.addStretch(1)
        for label in (self.unit, self._subject, self.effects, self.stand, self.warnings):
            label.setWordWrap(True)
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.setWidget(content)
        self._size()

    def _size(self) -> None:
        self.setMinimumWidth(_NARROW_LINES * self.fontMetrics().height())

    def _paint_sign(self) -> None:
        if self.shown is not None:
            edge = self.fontMetrics().height()
            icon = sign_icon(VERDICT_SIGNS[self.shown.outcome], colours(self))
            self._sign.setPixmap(icon.pixmap(edge, edge))


def _listed(title: str, lines: Sequence[str]) -> str:
    return "\n".join([f"{title}:", *(f"  {line}" for line in lines)]) if lines else ""
