"""Every screen of the window in every language, colour and size of text: pictures, and what is wrong on them.

What counts as wrong is said in `window_flaws`.
`xvfb-run --server-args="-screen 0 3840x2160x24" python -m benchmarks.window_tour`
"""

import argparse
import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from datetime import UTC, datetime
from itertools import product
from pathlib import Path

from PySide6.QtCore import QSettings
from PySide6.QtWidgets import QApplication, QTableWidgetSelectionRange, QTabWidget, QWidget

from benchmarks.window_flaws import faint, flaws
from benchmarks.window_marks import faint_marks
from tumble.app.cut_off import CutOff
from tumble.app.stand import load_stand
from tumble.messages import Language
from tumble.procedures.first_method import FIRST
from tumble.procedures.methods.dividing_head.layout import LAYOUT
from tumble.window.look.language import spoken
from tumble.window.look.shades import Shade
from tumble.window.main_window import MainWindow
from tumble.window.start import Application, application

_SIZES = ((1280, 800), (1920, 1080), (3840, 2160))
_SCALES = (1.0, 2.0)
_PROGRAMME = """\
name = "tour"
dwell_s = 0.1
settle_s = 0.0

[[procedure]]
kind = "sweep"
step_deg = 30.0
points = 12

[limits]
u0 = { min = 2.4, max = 2.6 }
ky = { min = -0.001, max = 0.001 }
"""

_STOPPED = CutOff(
    path=Path("stopped.mcap"),
    method=FIRST,
    serial_number="SN-1",
    programme_name="tour",
    points=3,
    ending="",
    stand_name="tour",
    began_at=datetime(2026, 1, 1, tzinfo=UTC),
)
_STAND = """\
name = "tour"

[head]
driver = "simulated"
limits_deg = [-180.0, 760.0]

[daq]
driver = "simulated"

[simulated]
preset = "DXL203EB"
"""


class Tour:
    """A window that is taken through its states."""

    def __init__(self, running: Application, folder: Path) -> None:
        self._running = running
        self._programme = folder / "tour.toml"
        self._programme.write_text(_PROGRAMME, encoding="utf-8")
        self._stand = folder / "stand.toml"
        self._stand.write_text(_STAND, encoding="utf-8")

    @property
    def window(self) -> MainWindow:
        """The window as it is now."""
        return self._running.window

    def measure(self) -> None:
        """Make a result, and two records of a unit."""
        run, result = self.window.run, self.window.result
        self.window.open(run)
        run.form.add_programme(str(self._programme))
        for _ in range(2):
            result.presentation = None
            run.form.serial.setText("SN-1")
            run.controls.start.click()
            self._wait(lambda: result.presentation is not None and not self.window.busy)

    def take(self, language: Language, shade: Shade, size: tuple[int, int], scale: float) -> None:
        """Have the window look like that."""
        if spoken() is not language:
            before = self.window
            self.window.choices.choose_language(language)
            self._wait(lambda: self.window is not before)
        if self.window.result.presentation is None:
            self.measure()
        self.window.choices.choose_scale(scale)
        self.window.choices.choose_shade(shade)
        self.window.resize(*size)
        self.settle()

    def states(self) -> Iterator[str]:
        """Go from state to state, by their names."""
        window = self.window
        for place, screen in zip(window.frame.places, window.frame.screens, strict=True):
            window.open(screen)
            yield from (f"{place.sign}{tab}" for tab in self._tabs(screen))
        yield from self._comparing()
        yield from self._asking()
        window.open(window.stand)
        window.stand.open(self._stand)
        window.stand.edit()
        self.settle()
        yield "editor"
        window.stand.editor.leave()
        window.stand.use(load_stand())
        window.tell(ValueError("bent"))
        window.stand.open(self._programme)
        window.way_out._ask()
        self.settle()
        yield "notices"
        while window.frame.close_newest():
            pass
        window.finding.begin()
        self.settle()
        yield "finder"
        window.frame.close_newest()

    def _comparing(self) -> Iterator[str]:
        """A record in short, and two beside each other."""
        records = self.window.records
        self.window.open(records)
        self.settle()
        records.table.selectRow(0)
        if records.tabs.indexOf(records.preview) >= 0:
            records.tabs.setCurrentWidget(records.preview)
        self._wait(lambda: records.preview.shown is not None)
        self.settle()
        yield "short"
        two = QTableWidgetSelectionRange(0, 0, 1, records.table.columnCount() - 1)
        records.table.setRangeSelected(two, True)
        records.compare_button.click()
        self._wait(lambda: records.tabs.currentWidget() is records.comparison)
        self.settle()
        yield "comparison"
        records.table.clearSelection()
        records.tabs.setCurrentIndex(0)

    def _asking(self) -> Iterator[str]:
        """What a run that waits for somebody shows, and one that was stopped."""
        run = self.window.run
        self.window.open(run)
        asking: dict[str, Callable[[], object]] = {
            "offer": lambda: run.offer((_STOPPED,)),
            "mount": lambda: run.view.ask(LAYOUT.ask("mount", "edge")),
            "reading": lambda: run.view.ask_reading(123.5, ""),
            "unit": lambda: run.view.ask_unit("SN-2"),
        }
        for state, ask in asking.items():
            ask()
            self.settle()
            yield state
            run.offered.withdraw()
            run.view.ask_nothing()

    def _tabs(self, screen: QWidget) -> Iterator[str]:
        """Turn to every tab of a screen, the one that is chosen first; a screen without tabs is one page."""
        self.settle()
        yield ""
        for tabs in screen.findChildren(QTabWidget):
            first = tabs.currentIndex()
            for number in (number for number in range(tabs.count()) if number != first):
                tabs.setCurrentIndex(number)
                self.settle()
                yield f"-{number}"
            tabs.setCurrentIndex(first)

    def settle(self) -> None:
        """Let the window come to rest."""
        self._wait(lambda: not self.window.background.is_busy)
        for _ in range(20):
            QApplication.processEvents()

    def leave(self) -> None:
        """Close the window."""
        self.window.leave()
        self._wait(lambda: not self.window.isVisible())

    def _wait(self, condition: Callable[[], bool]) -> None:
        while not condition():
            QApplication.processEvents()
            time.sleep(1e-3)  # whoever works in a thread has Python meanwhile


def pale(window: MainWindow) -> list[str]:
    """Texts and marks that do not stand out from their grounds."""
    return [*faint(window), *faint_marks(window)]


def _application_in(folder: Path) -> Application:
    """A window with settings and a store of its own, and a simulated stand that takes no time."""
    qt = application()
    QSettings.setDefaultFormat(QSettings.Format.IniFormat)
    QSettings.setPath(QSettings.Format.IniFormat, QSettings.Scope.UserScope, str(folder))
    QSettings().setValue("simulation/speed", 0)
    QSettings().setValue("simulation/imagined", "true")
    return Application(qt, folder / "store")


def main() -> None:
    """Take the tour, write pictures, and say what is wrong."""
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--pictures", type=Path, help="a folder for them; none are written without")
    arguments.add_argument("--quick", action="store_true", help="1280 × 800 only")
    chosen = arguments.parse_args()
    found: list[str] = []
    with tempfile.TemporaryDirectory() as name:
        os.environ["XDG_STATE_HOME"] = name
        tour = Tour(_application_in(Path(name)), Path(name))
        sizes = _SIZES[: 1 if chosen.quick else None]
        looks = product(Language, (Shade.LIGHT, Shade.DARK, Shade.CONTRAST), sizes, _SCALES)
        for language, shade, size, scale in looks:
            tour.take(language, shade, size, scale)
            for state in tour.states():
                look = f"{language}-{shade}-{size[0]}x{size[1]}-{scale:.0%}-{state}".replace("%", "")
                if chosen.pictures:
                    chosen.pictures.mkdir(parents=True, exist_ok=True)
                    tour.window.grab().save(str(chosen.pictures / f"{look}.png"))
                wrong = [*flaws(tour.window, language), *(pale(tour.window) if scale == 1.0 else [])]
                found += [f"{look}: {each}" for each in wrong]
        tour.leave()
    print("\n".join(found))
    print(f"{len(found)} flaws")
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
