"""How long a search on the screen Records takes in a store of many records: from the last key to the table.

    python -m benchmarks.record_search --records 100000

The store is made of one run of the simulated stand, whose record is copied under other numbers, days and units: size
and content are those of a real one. It is made once in the folder that is given, and used again.
"""

import argparse
import math
import os
import sqlite3
import statistics
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from datetime import UTC, datetime, timedelta
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tumble.app.calibrating import calibrate
from tumble.app.running import Job
from tumble.app.stand import load_stand
from tumble.app.wiring import connect
from tumble.calibrations.records import DATABASE
from tumble.calibrations.records.store import Store
from tumble.procedures.programmes import load_programme

if TYPE_CHECKING:
    from PySide6.QtWidgets import QApplication

    from tumble.window.screens.records import RecordsScreen

_UNITS: Final = 5_000
"""Each has been measured as often as the others."""
_LOT: Final = 250
"""Units that are made together."""
_EFFECTS: Final = ("\nhysteresis\n", "", "", "\nhysteresis\nk_xx\n", "", "", "")
"""What was found, in turn, as the store keeps it."""
_FIRST: Final = datetime(2016, 1, 1, tzinfo=UTC)
_BETWEEN: Final = timedelta(minutes=50)
_TIMES: Final = 100
_WAITED_S: Final = 120.0
_COPY: Final = """
INSERT INTO records ({columns})
SELECT {values} FROM records WHERE id = :pattern
"""


def make_store(folder: Path, records: int) -> None:
    """Fill a store with copies of a record, unless it has so many."""
    if not (folder / DATABASE).is_file():
        job = Job(stand=load_stand(), programme=load_programme("quick"), serial_number="PATTERN")
        calibrate(job, connect(job.stand), folder)
    pattern = Store.existing(folder).standing()[0]
    with sqlite3.connect(folder / DATABASE) as database:
        there = database.execute("SELECT count(*) FROM records").fetchone()[0]
        columns = [row[1] for row in database.execute("PRAGMA table_info(records)")]
        changed = {
            "id": ":id",
            "serial_number": ":serial",
            "measured_at": ":moment",
            "created_at": ":moment",
            "provenance": "json_set(provenance, '$.serial_number', :serial, '$.measured_at', :moment)",
            "writer": "NULL",
            "sequence": "NULL",
            "outcome": ":outcome",
            "lot": ":lot",
            "findings": ":findings",
        }
        copy = _COPY.format(columns=", ".join(columns), values=", ".join(changed.get(name, name) for name in columns))
        database.executemany(copy, _copies(pattern, there, records))


def _copies(pattern: str, first: int, last: int) -> Iterator[dict[str, str]]:
    for number in range(first, last):
        moment = _FIRST + number * _BETWEEN
        yield {
            "pattern": pattern,
            "id": f"{moment:%Y%m%d-%H%M%S}-{number:06x}",
            "serial": f"SN-{number % _UNITS:05d}",
            "moment": f"{moment:%Y-%m-%dT%H:%M:%S.%f}Z",
            "outcome": "fail" if number % 17 == 0 else "pass",
            "lot": f"L-{number % _UNITS // _LOT:03d}",
            "findings": _EFFECTS[number % len(_EFFECTS)],
        }


class Watch:
    """A window at the store, and the time that it takes to show what is looked for."""

    def __init__(self, application: "QApplication", screen: "RecordsScreen") -> None:
        self._application, self._screen = application, screen
        self._shown = 0
        screen.shown.connect(self._count)

    def time_ms(self, change: Callable[[], object]) -> tuple[float, float]:
        """Milliseconds until what a change asks for is painted, by the clock and of a processor."""
        before, began_s, began_cpu_s = self._shown, time.perf_counter(), time.process_time()
        change()
        self.wait(lambda: self._shown > before)
        self._application.processEvents()  # the table is painted
        return (time.perf_counter() - began_s) * 1000.0, (time.process_time() - began_cpu_s) * 1000.0

    def wait(self, condition: Callable[[], object]) -> None:
        """Let the window do what it has to do, without taking a processor from the search for waiting."""
        from PySide6.QtCore import QEventLoop

        began_s = time.perf_counter()
        while not condition():
            self._application.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents)
            if time.perf_counter() - began_s > _WAITED_S:
                raise SystemExit(f"the table does not show what was looked for: {self._screen.said.text()}")

    def rest(self) -> None:
        """Wait until the trend is drawn, too, and painted: that is no part of the search that comes next."""
        self.wait(lambda: self._screen.trend.records is self._screen.records)
        self._application.processEvents()

    def _count(self) -> None:
        self._shown += 1


def measure(store: Path, times: int) -> None:
    """Open the window, and time searches in it."""
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from PySide6.QtCore import QSettings, QSignalBlocker

    from tumble.window.start import Application, application

    with tempfile.TemporaryDirectory() as settings:
        QSettings.setDefaultFormat(QSettings.Format.IniFormat)
        QSettings.setPath(QSettings.Format.IniFormat, QSettings.Scope.UserScope, settings)
        qt = application()
        began_s = time.perf_counter()
        window = Application(qt, store).window
        screen, search = window.records, window.records.search
        window.open(screen)
        watch = Watch(qt, screen)
        watch.wait(lambda: screen.records and not window.background.is_busy)
        listed_s = time.perf_counter() - began_s
        watch.wait(lambda: not screen.surveyor.is_busy)
        print(f"first list: {listed_s:.2f} s, everything around it: {time.perf_counter() - began_s:.2f} s")
        for title, field, term in (
            ("one unit", search.serial, "SN-01234"),
            ("a hundred units", search.serial, "SN-012"),
            ("no unit", search.serial, "nobody"),
            ("no unit, in Cyrillic letters", search.serial, "прилад"),
            ("all", search.serial, ""),
            ("a lot", search.lot, "L-013"),
            ("no lot", search.lot, "none"),
            ("all lots", search.lot, ""),
        ):
            looks = []
            for _ in range(times):
                with QSignalBlocker(field):
                    field.setText(f"{term}?")
                looks.append(watch.time_ms(partial(field.setText, term)))
                watch.rest()
            print(f"{title}: {_told([clock for clock, _ in looks])}; processor {_told([cpu for _, cpu in looks])}")
        for place in range(search.finding.count()):
            looks = []
            for _ in range(times):
                with QSignalBlocker(search.finding):
                    search.finding.setCurrentIndex(-1)
                looks.append(watch.time_ms(partial(search.finding.setCurrentIndex, place)))
                watch.rest()
            title = f"effect: {search.finding.itemText(place)}"
            print(f"{title}: {_told([clock for clock, _ in looks])}; processor {_told([cpu for _, cpu in looks])}")
        window.leave()
        qt.processEvents()


def _told(times_ms: Sequence[float]) -> str:
    """Median, 95th percentile and the longest."""
    in_order = sorted(times_ms)
    rank = math.ceil(0.95 * len(in_order)) - 1
    return f"median {statistics.median(in_order):.0f} ms, 95% {in_order[rank]:.0f} ms, at most {in_order[-1]:.0f} ms"


def main() -> None:
    """Make the store, and measure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--records", type=int, default=100_000)
    parser.add_argument("--times", type=int, default=_TIMES, help="how often each search is timed")
    parser.add_argument("--folder", type=Path, help="where the store is kept; in a temporary folder without")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = arguments.folder or Path(temporary) / "store"
        make_store(folder, arguments.records)
        print(f"{arguments.records} records, {(folder / DATABASE).stat().st_size / 1e6:.0f} MB")
        measure(folder, arguments.times)


if __name__ == "__main__":
    main()
