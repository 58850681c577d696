"""The pictures of the handbook, taken anew of the window as it is.

Everything on them is measured on simulated stands while they are taken.
`xvfb-run --server-args="-screen 0 1280x800x24" python -m benchmarks.window_pictures docs/window`
"""

import argparse
from collections.abc import Callable
from contextlib import chdir
from pathlib import Path
from shutil import copytree
from typing import Final

from PySide6.QtWidgets import QTableWidgetSelectionRange

from benchmarks.window_hands import Hands, look_on, window_in_english
from tumble.app.stand import load_stand
from tumble.messages import Language
from tumble.window.look.shades import Shade
from tumble.window.main_window import MainWindow
from tumble.window.start import Application

_SAMPLES: Final = Path("docs/samples").resolve()
_SIZE: Final = (1280, 800)
_WITHIN_S: Final = 20.0
_AT_ONCE, _AS_IT_IS = 0, 1
"""Places in the list of speeds of a simulated stand."""
_REST_S: Final = 0.5
"""After which everything is painted as it stays."""
_BENCH: Final = """\
name = "bench-1"

[head]
driver = "simulated"
limits_deg = [-180.0, 760.0]
certificate = "HEAD-2026-17"
calibration_due = 2027-05-01

[daq]
driver = "simulated"
certificate = "DMM-2025-204"
calibration_due = 2026-12-15

[simulated]
preset = "DXL203EB"
"""
_BY_HAND: Final = _BENCH.replace('driver = "simulated"', 'driver = "manual"', 1)
_ACCEPTANCE: Final = """\
name = "acceptance"
dwell_s = 0.5
realisations = 2

[[procedure]]
kind = "sweep"
step_deg = 30.0
points = 12

[[procedure]]
kind = "sweep"
mount = "edge"
step_deg = 30.0
points = 12

[limits]
kx = { min = 0.99, max = 1.01 }
kxy = { min = 0.0008, max = 0.0012 }
"""


class Album:
    """A window, what is done with it for a picture, and where that goes."""

    def __init__(self, running: Application, hands: Hands, folder: Path, pictures: Path) -> None:
        self._running, self._hands, self._pictures = running, hands, pictures
        copytree(_SAMPLES, folder / "samples")
        self._samples = Path("samples")

    @property
    def window(self) -> MainWindow:
        """The window as it is now."""
        return self._running.window

    def fill(self) -> None:
        """Take one picture after the other."""
        for take in (self._stand, self._by_hand, self._runs, self._mount, self._loop, self._records, self._others):
            take()
        self._ukrainian()

    def _stand(self) -> None:
        window = self.window
        window.resize(*_SIZE)
        self._choose(_BENCH, _AS_IT_IS)
        window.stand.connect_button.click()
        self._wait(lambda: window.worker.session.is_connected and not window.busy, "the connection")
        window.stand.jog.home.click()
        self._wait(lambda: not window.busy, "the reference")
        look_on(4.0)  # a line through what the meter reads
        window.stand.jog.angle.setText("40")
        window.stand.jog.go.click()
        look_on(1.0)
        self._save("stand")
        self._wait(lambda: not window.busy, "the angle")

    def _by_hand(self) -> None:
        window = self.window
        self._choose(_BY_HAND, _AT_ONCE)
        self._begin("SN-1042", self._file("acceptance.toml", _ACCEPTANCE))
        self._wait(lambda: window.run.view.asks, "the mount")
        self._hands.push("F9")
        self._wait(window.run.view.reading.isVisible, "the setting")
        self._save("manual")
        self._stop()

    def _runs(self) -> None:
        window = self.window
        window.stand.use(load_stand())
        window.stand.simulation.imagined.setChecked(True)
        self._queue("seed")
        self._wait(lambda: len(window.run.view.points) > 150, "a third of a run")
        self._save("queue")
        window.run.view.tabs.setCurrentIndex(0)
        self._save("run")
        self._stop()

    def _mount(self) -> None:
        window = self.window
        window.stand.simulation.imagined.setChecked(False)
        self._begin("SN-1046", "reversal")
        self._wait(lambda: window.run.view.asks, "the mount")
        self._save("mount")
        self._stop()

    def _loop(self) -> None:
        window = self.window
        window.stand.open(self._samples / "bench.toml")
        window.stand.simulation.imagined.setChecked(True)
        self._measure("SN-1043", self._samples / "sweeps.toml")
        window.open(window.result)
        window.result.tabs.setCurrentWidget(window.result.loop)
        self._save("result-loop")

    def _records(self) -> None:
        window, records = self.window, self.window.records
        self._choose(_BENCH, _AT_ONCE)
        for serial in ("SN-1044", "SN-1045", "SN-1044"):
            self._measure(serial, self._file("acceptance.toml", _ACCEPTANCE))
        window.open(records)
        records.refresh()
        self._wait(lambda: len(records.records) == 4 and not records.surveyor.is_busy, "the records")
        records.tabs.setCurrentWidget(records.preview)
        records.table.selectRow(0)
        self._wait(lambda: records.preview.shown is not None, "the record in short")
        self._save("records")
        records.table.clearSelection()
        for row in (0, 2):
            across = QTableWidgetSelectionRange(row, 0, row, records.table.columnCount() - 1)
            records.table.setRangeSelected(across, True)
        records.compare_button.click()
        self._wait(lambda: records.tabs.currentWidget() is records.comparison, "the comparison")
        self._save("comparison")

    def _others(self) -> None:
        window = self.window
        window.open(window.settings)
        self._save("settings")
        window.open(window.stand)
        window.finding.begin()
        self._hands.type("sto")
        self._save("finder")
        window.frame.close_newest()

    def _ukrainian(self) -> None:
        before = self.window
        before.choices.choose_language(Language.UKRAINIAN)
        self._wait(lambda: self.window is not before, "the language")
        window = self.window
        window.stand.simulation.imagined.setChecked(True)
        self._measure("SN-1045", self._file("acceptance.toml", _ACCEPTANCE))
        window.resize(*_SIZE)
        window.open(window.result)
        self._save("uk-light-parameters")
        window.choices.choose_shade(Shade.DARK)
        window.stand.use(load_stand())
        self._begin("SN-1043", "seed")
        self._wait(lambda: len(window.run.view.points) > 200, "half a run")
        self._save("uk-dark-run")
        self._stop()
        window.choices.choose_scale(2.0)
        self._save("uk-dark-text200")

    def _choose(self, stand: str, speed: int) -> None:
        """Have a stand on screen, in a hurry or not."""
        self.window.open(self.window.stand)
        self.window.stand.open(self._file("bench.toml", stand))
        self.window.stand.simulation.speed.setCurrentIndex(speed)

    def _begin(self, serial: str, programme: str | Path) -> None:
        run = self.window.run
        self.window.open(run)
        run.form.add_programme(str(programme))
        run.form.serial.setText(serial)
        run.form.lot.setText("L-26")
        run.form.operator.setText("Ann")
        self._wait(run.controls.start.isEnabled, "the stand")
        run.controls.start.click()

    def _queue(self, programme: str) -> None:
        run = self.window.run
        self.window.open(run)
        run.form.add_programme(programme)
        run.form.lot.setText("L-26")
        run.form.operator.setText("Ann")
        for serial in ("SN-1043", "SN-1044", "SN-1045"):
            run.form.serial.setText(serial)
            run.controls.add.click()
        run.controls.start_queue.click()

    def _measure(self, serial: str, programme: str | Path) -> None:
        """A run to its result."""
        self.window.result.presentation = None
        self._begin(serial, programme)
        self._wait(lambda: self.window.result.presentation is not None and not self.window.busy, "the result")

    def _stop(self) -> None:
        """End a run, and be rid of it."""
        window = self.window
        window.worker.stop()
        self._wait(lambda: not window.busy and window.run.offered.isVisible(), "the stop")
        window.run.offered.later_button.click()
        window.run.queue.clear()
        while window.frame.close_newest():
            pass

    def _file(self, name: str, text: str) -> Path:
        """A file beside the store, called as one would from there: pictures show no folder of this machine."""
        path = Path(name)
        path.write_text(text, encoding="utf-8")
        return path

    def _wait(self, condition: Callable[[], object], what: str) -> None:
        self._hands.wait(condition, what, _WITHIN_S)

    def _save(self, name: str) -> None:
        look_on(_REST_S)
        self.window.grab().save(str(self._pictures / f"{name}.png"))
        print(name, flush=True)


def main() -> None:
    """Take the pictures."""
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("pictures", type=Path, help="folder that they are written to")
    pictures: Path = arguments.parse_args().pictures.resolve()
    pictures.mkdir(parents=True, exist_ok=True)
    with window_in_english() as (running, hands, folder), chdir(folder):
        Album(running, hands, folder, pictures).fill()


if __name__ == "__main__":
    main()
