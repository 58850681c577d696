"""The screen Help: the handbook, the keys, and what program this is."""

import platform
from collections.abc import Callable, Sequence
from html import escape
from pathlib import Path

import PySide6
from PySide6.QtCore import QUrl
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QVBoxLayout, QWidget

from tumble.app.identity import program_identity
from tumble.window.handbook import CONTENTS, FIRST_PAGE, handbook
from tumble.window.look.language import tr
from tumble.window.look.plain import PlainLabel
from tumble.window.shortcuts import Shortcut
from tumble.window.stop_guard import STOP_KEYS
from tumble.window.widgets.dialog import YES_KEY
from tumble.window.widgets.page_reader import PageReader


class HelpScreen(QWidget):
    """A reader, and the pages that one looks for first."""

    def __init__(
        self, find_keys: Callable[[], Sequence[Shortcut]], store: Callable[[], Path], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._find_keys, self._store = find_keys, store
        self.reader = PageReader()
        self._folder = handbook()
        self._nothing = PlainLabel(tr("The handbook was not installed with the program."))
        self._nothing.setVisible(self._folder is None)
        self._lay_out()

    def open_handbook(self) -> None:
        """Show how the window is worked."""
        self._open(FIRST_PAGE)

    def open_keys(self) -> None:
        """Show every key."""
        self._show(tr("Keys"), _rows(_fixed_keys()) + _rows(_changeable_keys(self._find_keys())))

    def open_about(self) -> None:
        """Show what program this is."""
        program = program_identity()
        facts = {
            tr("Version"): program.version,
            tr("Commit"): program.git_commit[:12] + (tr(", changed since") if program.git_dirty else ""),
            "Python": platform.python_version(),
            "Qt": PySide6.__version__,
            tr("System"): platform.platform(),
            tr("Licence"): "BSD-3-Clause",
            tr("Store"): str(self._store().resolve()),
        }
        self._show(tr("About tumble"), _rows({name: text for name, text in facts.items() if text}))

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802  # Qt's name
        """Begin with the handbook."""
        super().showEvent(event)
        if self.reader.document().isEmpty():
            self.open_handbook()

    def _open(self, page: str) -> None:
        if self._folder is None:
            self.open_keys()
            return
        self.reader.open_page(self._folder / page)

    def _show(self, title: str, rows: str) -> None:
        self.reader.setSource(QUrl())
        self.reader.setHtml(f"<h2>{escape(title)}</h2><table cellspacing='6'>{rows}</table>")

    def _lay_out(self) -> None:
        across = QHBoxLayout()
        for title, do in (
            (tr("The window"), self.open_handbook),
            (tr("Contents"), lambda: self._open(CONTENTS)),
            (tr("Keys"), self.open_keys),
            (tr("About tumble"), self.open_about),
            (tr("Back"), self.reader.backward),
        ):
            button = QPushButton(title)
            button.clicked.connect(lambda _checked, do=do: do())
            across.addWidget(button)
        across.addStretch(1)
        column = QVBoxLayout(self)
        column.addLayout(across)
        column.addWidget(self._nothing)
        column.addWidget(self.reader, stretch=1)


def _rows(facts: dict[str, str]) -> str:
    return "".join(f"<tr><td><b>{escape(key)}</b></td><td>{escape(text)}</td></tr>" for key, text in facts.items())


def _fixed_keys() -> dict[str, str]:
    """Keys that stay what they are, and what they do."""
    return {
        ", ".join(STOP_KEYS): tr("stop the head, whatever is going on"),
        "Esc": tr("close what lies over the screens; it stops nothing"),
        YES_KEY: tr("yes to the question that is asked"),
        "Enter": tr("the head reads as set, or as typed; in Records, open the record"),
        "Backspace, Home": tr("in a plot: one step back, the whole picture"),
    }


def _changeable_keys(found: Sequence[Shortcut]) -> dict[str, str]:
    return {each.chosen.toString(each.chosen.SequenceFormat.NativeText): each.title for each in found}
