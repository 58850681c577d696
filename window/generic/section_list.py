"""The sections of a result, one below the other."""

from collections.abc import Sequence
from typing import Final

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QScrollArea, QVBoxLayout, QWidget

from tumble.calibrations.core.view import Section
from tumble.window.generic.presenting import sections_of
from tumble.window.look.language import tr
from tumble.window.look.plain import PlainLabel
from tumble.window.look.sentences import in_language
from tumble.window.parts import ResultTab
from tumble.window.widgets.table import Table
from tumble.window.work.presentation import Presentation

_SELECTED: Final = Qt.TextInteractionFlag.TextSelectableByMouse | Qt.TextInteractionFlag.TextSelectableByKeyboard
"""By both, to be copied."""


class SectionList(QScrollArea):
    """Heading, sentences and table of each; figures, and what is said of them, are in the report."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWidgetResizable(True)
        self.tables: list[Table] = []

    def show_presentation(self, presentation: Presentation) -> None:
        """Show another result."""
        self.show_sections(sections_of(presentation))

    def show_sections(self, sections: Sequence[Section]) -> None:
        """Show other sections, those without sentences or rows left out."""
        content, self.tables = QWidget(), []
        column = QVBoxLayout(content)
        for section in sections:
            if section.lines or section.rows or section.code:
                self._add(section, column)
        column.addStretch(1)
        self.setWidget(content)

    def _add(self, section: Section, column: QVBoxLayout) -> None:
        if section.title:
            title = QLabel(in_language(section.title))
            title.setObjectName("heading")
            column.addWidget(title)
        explained = [section.caption] if section.caption and not section.figure else []
        if sentences := [*section.lines, *explained]:
            said = PlainLabel("\n".join(map(in_language, sentences)))
            said.setWordWrap(True)
            column.addWidget(said)
        if section.rows:
            table = Table([in_language(heading) for heading in section.headings])
            table.fill([[in_language(cell) for cell in row] for row in section.rows])
            table.show_whole()
            column.addWidget(table)
            self.tables.append(table)
        if section.code:
            code = PlainLabel(section.code)
            code.setObjectName("code")
            code.setTextInteractionFlags(_SELECTED)
            column.addWidget(code)


def section_tabs() -> tuple[ResultTab, ...]:
    """All sections on one tab."""
    sections = SectionList()
    return (ResultTab(title=tr("Details"), widget=sections, show=sections.show_presentation),)
