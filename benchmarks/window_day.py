"""A day of an operator at the window, by keys alone: what goes well, and what one has to know.

Three units in the queue, of which one was mistyped and is put right; a stop in the middle of a run, and a meter whose
cable falls out in the middle of another, both gone on with; two records compared; a report for the customer. Every
station is said, and grabbed where `--pictures` names a folder.

`xvfb-run --server-args="-screen 0 1280x800x24" python -m benchmarks.window_day`
"""

import argparse
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from benchmarks.endurance.processes import ZABER_SCPI, emulated
from benchmarks.window_hands import Hands, StuckError, look_on, window_in_english
from tumble.app.running import Job
from tumble.app.stand import load_stand
from tumble.procedures.programmes import load_programme
from tumble.window.start import Application
from tumble.window.work.run_queue import Stage

_WITHIN_S = 60.0
_POINTS_OF_THE_THIRD = 12
"""So many are there when the cable falls out; those that the resumed run takes again are among them."""
_PROGRAMME = """\
name = "incoming"
dwell_s = 1.0

[[procedure]]
kind = "sweep"
step_deg = 15.0
points = 24

[[procedure]]
kind = "flip"
axes = ["x"]
"""


_SPEED = 10.0
_CABLE_S = 5.0
"""Until the cable is in again: a link is given up after 30 s of the stand, here 3 s, and this one is out for 6 s."""
_CABLE = """\
[[fault]]
device = "daq"
kind = "drop"
at = {{ point = {point} }}
lasts_s = 6.0
"""


@contextmanager
def _emulated(folder: Path) -> Iterator[Path]:
    """The stand of the day, in a process of its own: its meter loses its cable while the third unit is measured."""
    programme = load_programme(_written(folder / "incoming.toml", _PROGRAMME))
    points = Job(stand=load_stand(), programme=programme, serial_number="").plan().dwells
    faults = _written(folder / "faults.toml", _CABLE.format(point=2 * points + _POINTS_OF_THE_THIRD))
    served = ZABER_SCPI.write_stand(folder / "served.toml")
    with emulated(served, _SPEED, "--faults", str(faults)) as addresses:
        yield ZABER_SCPI.at(addresses).write_stand(folder / "stand.toml")


def _written(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


class Day:
    """The stations of a day, one method each, in their order."""

    def __init__(self, running: Application, hands: Hands, stand: Path, pictures: Path | None) -> None:
        self._window, self.hands, self._stand, self._pictures = running.window, hands, stand, pictures
        self._count = 0

    def survive(self) -> bool:
        """Go from station to station; false where there is no way on, which is said."""
        try:
            self.live()
        except StuckError as stuck:
            print(f"stuck: {stuck}", *(card.notice.text for card in self._window.notices.cards), sep="\n")
            self._grab("stuck")
            return False
        return True

    def live(self) -> None:
        """Go from station to station."""
        for station in (
            self._begin, self._queue, self._correct, self._stop, self._go_on, self._fail, self._mend, self._compare,
            self._report, self._leave,
        ):  # fmt: skip
            pressed = self.hands.pressed
            station()
            print(f"{(station.__doc__ or '').rstrip('.')}: {self.hands.pressed - pressed} keys", flush=True)
            self._grab(station.__name__.strip("_"))

    def _begin(self) -> None:
        """The window is there; stand and programme are files."""
        hands, window = self.hands, self._window
        hands.press("Ctrl+1")
        hands.access("F")
        hands.scan(str(self._stand))
        hands.wait(lambda: window.stand.loaded.path == self._stand, "the stand")
        programme = str(self._stand.with_name("incoming.toml"))
        hands.press("Ctrl+2")
        hands.access("F")
        hands.scan(programme)
        hands.wait(lambda: window.run.form.chosen == programme, "the programme")

    def _queue(self) -> None:
        """Three units are scanned into the queue, one of them mistyped."""
        for serial in ("SN-101", "SN-1O2", "SN-103"):
            self.hands.scan(serial)
            self.hands.push("F2")
        self._expect(["SN-101", "SN-1O2", "SN-103"])

    def _correct(self) -> None:
        """The mistyped unit is taken out, and the right one put in its place."""
        hands, view = self.hands, self._window.run.queue_view
        hands.scan("SN-102")
        hands.push("F2")
        hands.tab_to(view.table)
        hands.press("Down")
        hands.press("Del")
        hands.press("Down")
        hands.press("Alt+Up")
        self._expect(["SN-101", "SN-102", "SN-103"])

    def _stop(self) -> None:
        """The queue runs, every mount is confirmed, and STOP is pressed in the middle of the second unit."""
        run = self._window.run
        self.hands.push("F4")
        self._attend(lambda: self._stages()[1] is Stage.MEASURING and len(run.view.points) >= 5, "the second unit")
        self.hands.press("F12")
        self.hands.wait(lambda: self._stages()[1] is Stage.STOPPED, "the stop")

    def _go_on(self) -> None:
        """The stopped run is gone on with, and the queue after it."""
        self._resume()
        self._attend(lambda: self._units() >= {"SN-101", "SN-102"}, "the second record")
        self.hands.press("Ctrl+2")
        self.hands.push("F4")

    def _fail(self) -> None:
        """The meter of the third unit loses its cable, and the window says so."""
        self._attend(lambda: self._stages()[2] is Stage.FAILED, "the fault")

    def _mend(self) -> None:
        """The cable is put in again, and the run gone on with."""
        look_on(_CABLE_S)
        self._resume()
        self._attend(lambda: self._units() == {"SN-101", "SN-102", "SN-103"}, "the third record")

    def _resume(self) -> None:
        offered = self._window.run.offered
        self.hands.wait(lambda: offered.isVisible() and offered.button.isEnabled(), "the offer")
        self._grab("offer")
        self.hands.push("F7")

    def _compare(self) -> None:
        """Two records are compared."""
        hands, records = self.hands, self._window.records
        hands.press("Ctrl+4")
        hands.tab_to(records.table)
        hands.press("Shift+Down")
        hands.access("C")
        hands.wait(lambda: records.tabs.currentWidget() is records.comparison, "the comparison")

    def _report(self) -> None:
        """The report of a record is written for the customer."""
        hands, page = self.hands, self._stand.with_name("for the customer.pdf")
        hands.tab_to(self._window.records.table)
        hands.press("Down")  # one record alone is chosen
        hands.access("E")
        hands.press("Ctrl+A")
        hands.scan(str(page))
        hands.wait(page.is_file, "the report", _WITHIN_S)

    def _leave(self) -> None:
        """The window is closed."""
        self.hands.press("Ctrl+Q")
        self.hands.wait(lambda: not self._window.isVisible(), "the end")

    def _attend(self, seen: Callable[[], bool], what: str) -> None:
        """Do what is asked for until something is seen."""
        view = self._window.run.view
        while not seen():
            self.hands.wait(lambda: seen() or view.asks or view.unit.isVisible(), what, _WITHIN_S)
            if not seen():
                self.hands.push("F9")

    def _expect(self, units: list[str]) -> None:
        there = [row[0] for row in self._window.run.queue_view.table.texts()]
        if there != units:
            raise StuckError(f"the queue is {there}, and not {units}")

    def _stages(self) -> list[Stage]:
        return [entry.stage for entry in self._window.run.queue.queue.entries]

    def _units(self) -> set[str]:
        return {record.provenance.serial_number for record in self._window.records.records}

    def _grab(self, name: str) -> None:
        if self._pictures:
            self._pictures.mkdir(parents=True, exist_ok=True)
            self._count += 1
            self._window.grab().save(str(self._pictures / f"{self._count:02}-{name}.png"))


def main() -> None:
    """Live through the day."""
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--pictures", type=Path, help="a folder for them; none are written without")
    chosen = arguments.parse_args()
    with window_in_english() as (running, hands, folder), _emulated(folder) as stand:
        well = Day(running, hands, stand, chosen.pictures).survive()
    sys.exit(not well)


if __name__ == "__main__":
    main()
