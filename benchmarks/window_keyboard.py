"""The six methods in the window, each from scan or file to its report and back to its record, by keys alone.

No part of the window is called, nothing is clicked, no field is filled but by its keys: what is read is what is shown.
Each line says how many keys a method took and what came of it.

`xvfb-run --server-args="-screen 0 1920x1080x24" python -m benchmarks.window_keyboard`
"""

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QObject, QUrl, Slot
from PySide6.QtGui import QDesktopServices

from benchmarks.window_hands import Hands, StuckError, window_in_english
from tumble.window.start import Application

_SAMPLES = Path(__file__).parents[1] / "docs" / "samples"
_WITHIN_S = 240.0


@dataclass(frozen=True, kw_only=True)
class Measured:
    """A method whose unit is measured at a stand."""

    method: str
    programme: str
    serial: str


@dataclass(frozen=True, kw_only=True)
class Tabulated:
    """A method whose tables come from elsewhere."""

    method: str
    table: str


WAYS = (
    Measured(method="dividing_head", programme="quick", serial="DH-1"),
    Measured(method="triad", programme="12o", serial="TR-1"),
    Measured(method="gyrocompass", programme="0-90-180-270", serial="PG-1"),
    Measured(method="vibration", programme="vibration", serial="V-1"),
    Tabulated(method="head_reference", table="head.csv"),
    Tabulated(method="temperature", table="parameters.csv"),
)


class Operator:
    """Takes a unit of one method from its serial number, or a table from its file, to its report and its record."""

    def __init__(self, running: Application, hands: Hands) -> None:
        self._window, self.hands = running.window, hands
        self.opened: list[Path] = []
        """Reports that were handed to the desktop."""

    def hurry(self) -> None:
        """Have the simulated stands take no time; whoever is asked answers in person."""
        speed = self._window.stand.simulation.speed
        self.hands.press("Ctrl+1")
        self.hands.tab_to(speed)
        self.hands.choose(speed, "at once")

    def measure(self, way: Measured) -> str:
        """From the scan of a serial number to the report and the record."""
        hands, run = self.hands, self._window.run
        hands.press("Ctrl+2")
        hands.scan(way.serial)
        hands.access("P")
        hands.choose(run.form.programme, way.programme)
        before = self._shown
        hands.press("F5")
        asked = 0
        while self._shown is before:
            hands.wait(lambda: run.view.asks or self._shown is not before or self._complaints, "a result", _WITHIN_S)
            self._refuse_complaints()
            if run.view.asks:
                hands.push("F9")
                asked += 1
        self._open_report()
        self._open_record(way.serial)
        return f"{asked} requests answered, {self._window.result.verdict.text()}"

    def analyse(self, way: Tabulated) -> str:
        """From a file to the report and the record."""
        before = self._shown
        self.hands.press("Ctrl+4")
        self.hands.access("F")
        self.hands.type(str(_SAMPLES / way.table))
        self.hands.press("Return")
        self._wait_for_another_than(before)
        self._open_report()
        self._open_record(Path(way.table).stem)
        return self._window.result.verdict.text()

    def _open_report(self) -> None:
        count = len(self.opened)
        self.hands.access("R")
        self.hands.wait(lambda: len(self.opened) > count, "the report")
        if not self.opened[-1].read_text("utf-8").rstrip().endswith("</html>"):
            raise StuckError(f"{self.opened[-1]} is no whole report")

    def _open_record(self, serial: str) -> None:
        """Find the record by the unit, and open it; the search is left as it was."""
        records, before = self._window.records, self._shown
        self.hands.press("Ctrl+4")
        self.hands.access("S")
        self.hands.type(serial)
        self.hands.wait(lambda: {row[0] for row in records.table.texts()} == {serial}, "the record in the list")
        self.hands.tab_to(records.table)
        self.hands.press("Home")
        self.hands.press("Return")
        self._wait_for_another_than(before)
        self.hands.press("Ctrl+4")
        self.hands.access("S")
        self.hands.press("Ctrl+A")
        self.hands.press("Del")

    def _wait_for_another_than(self, before: object) -> None:
        self.hands.wait(lambda: self._shown is not before or self._complaints, "a result", _WITHIN_S)
        self._refuse_complaints()

    def _refuse_complaints(self) -> None:
        if self._complaints:
            raise StuckError("; ".join(self._complaints))

    @property
    def _shown(self) -> object:
        return self._window.result.presentation

    @property
    def _complaints(self) -> list[str]:
        return [card.notice.text for card in self._window.notices.cards]


def _one(operator: Operator, way: Measured | Tabulated) -> bool:
    pressed = operator.hands.pressed
    try:
        said = operator.measure(way) if isinstance(way, Measured) else operator.analyse(way)
    except StuckError as stuck:
        print(f"{way.method}: stuck: {stuck}", flush=True)
        return False
    print(f"{way.method}: {operator.hands.pressed - pressed} keys; {said}", flush=True)
    return True


def main() -> None:
    """Take every method its way."""
    argparse.ArgumentParser(description=__doc__.splitlines()[0]).parse_args()
    with window_in_english() as (running, hands, _):
        operator = Operator(running, hands)
        opener = _Opener(operator.opened)
        QDesktopServices.setUrlHandler("file", opener, "open")
        operator.hurry()
        well = [_one(operator, way) for way in WAYS]
        hands.press("Ctrl+Q")
        hands.wait(lambda: not running.window.isVisible(), "the end")
    sys.exit(not all(well))


class _Opener(QObject):
    """The desktop: a page is opened where a browser would do it."""

    def __init__(self, opened: list[Path]) -> None:
        super().__init__()
        self._opened = opened

    @Slot(QUrl)
    def open(self, url: QUrl) -> None:
        self._opened.append(Path(url.toLocalFile()))


if __name__ == "__main__":
    main()
