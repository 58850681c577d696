"""Every screen of the window in every language, colour and size of text: pictures, and what is wrong on them.

Wrong is a text that is cut off or in another language, a part that sticks out of its place, parts that lie on each
other, and a text that is too faint. `xvfb-run --server-args="-screen 0 3840x2160x24" python -m benchmarks.window_tour`
"""

import argparse
import os
import sys
import tempfile
from collections.abc import Callable, Iterator
from itertools import combinations, product
from pathlib import Path

import numpy as np
from PySide6.QtCore import QPoint, QSettings
from PySide6.QtGui import QColor, QImage, QRegion
from PySide6.QtWidgets import (
    QAbstractButton,
    QApplication,
    QComboBox,
    QFileDialog,
    QLabel,
    QLineEdit,
    QTabBar,
    QWidget,
)

from tumble.app.stand import load_stand
from tumble.messages import Language, translate
from tumble.window.look.language import spoken
from tumble.window.look.shades import Shade
from tumble.window.main_window import MainWindow
from tumble.window.start import Application, application

LEAST_CONTRAST = 4.5
"""WCAG 2.1, 1.4.3."""
_SHARPNESS = 3
"""Times larger than on screen: a stroke is then wide enough to have a pixel in its own colour."""
_EDGE_PX = 2
"""Width of what is drawn around a field or a button; it is no ground of letters."""
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
"""

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


def flaws(window: QWidget, language: Language) -> list[str]:
    """What is wrong with the texts that are shown, a sentence each."""
    parts = list(_with_text(window))
    met = [(one, other) for one, other in combinations(parts, 2) if _meet(one, other)]
    return [
        *(f"cut off: {_named(part)}" for part in parts if _is_cut(part)),
        *(f"sticks out: {_named(part)}" for part in parts if _sticks_out(part)),
        *(f"on each other: {_named(one)} and {_named(other)}" for one, other in met),
        *(f"not {language}: {_named(part)}" for part in parts if _is_foreign(part, language)),
    ]


def faint(window: QWidget) -> list[str]:
    """Texts that stand out from their ground by less than 4.5 : 1, measured on what is painted."""
    return [
        f"{contrast:.2f} : 1: {_named(part)}"
        for part in _with_text(window)
        if (contrast := painted_contrast(part)) < LEAST_CONTRAST
    ]


def painted_contrast(part: QWidget) -> float:
    """Contrast of the colour that is most frequent in a part, with the one that stands out most from it."""
    image = QImage(part.size() * _SHARPNESS, QImage.Format.Format_RGB32)
    image.setDevicePixelRatio(_SHARPNESS)
    image.fill(_ground(part))
    part.render(image, QPoint(), QRegion(), QWidget.RenderFlag.DrawChildren)
    edge = _EDGE_PX * _SHARPNESS
    colours, ground = _colours(image.copy(image.rect().adjusted(edge, edge, -edge, -edge)))
    return max(_contrast(ground, int(each)) for each in colours)


def _ground(part: QWidget) -> QColor:
    """What is painted behind a part, and around its letters, as its window shows it."""
    place = part.rect().translated(part.mapTo(part.window(), part.rect().topLeft()))
    return QColor(_colours(part.window().grab(place).toImage())[1])


def _colours(image: QImage) -> tuple[np.ndarray, int]:
    """The colours of an image, and the one that is most frequent."""
    pixels = np.frombuffer(image.convertToFormat(QImage.Format.Format_RGB32).constBits(), np.uint32)
    colours, counts = np.unique(pixels, return_counts=True)
    return colours, int(colours[counts.argmax()])


def _contrast(one: int, other: int) -> float:
    light, dark = sorted((_luminance(one), _luminance(other)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def _luminance(colour: int) -> float:
    """WCAG 2.1, relative luminance."""
    parts = [
        part / 12.92 if part <= 0.03928 else ((part + 0.055) / 1.055) ** 2.4
        for part in ((colour >> shift & 255) / 255 for shift in (16, 8, 0))
    ]
    return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]


def _with_text(window: QWidget) -> Iterator[QWidget]:
    """What is seen of labels, buttons and fields with a text; Qt's own dialogs are Qt's."""
    for part in window.findChildren(QWidget):
        if part.isVisible() and _text(part) and not part.visibleRegion().isEmpty() and not _is_of_qt(part):
            yield part


def _text(part: QWidget) -> str:
    match part:
        case QLabel() | QAbstractButton():
            return part.text()
        case QLineEdit():
            return part.text() or part.placeholderText()
        case QComboBox():
            return part.currentText()
    return ""


def _named(part: QWidget) -> str:
    return f"{type(part).__name__} “{_text(part)[:60]}”"


def _is_of_qt(part: QWidget) -> bool:
    parent: QWidget | None = part
    while parent is not None:
        if isinstance(parent, QFileDialog | QTabBar) or (isinstance(parent, QComboBox) and parent is not part):
            return True
        parent = parent.parentWidget()
    return False


def _is_cut(part: QWidget) -> bool:
    if isinstance(part, QLabel) and part.wordWrap():
        return part.heightForWidth(part.width()) > part.height() + 1
    if isinstance(part, QLineEdit):
        return part.fontMetrics().horizontalAdvance(_text(part)) > part.width() - 4
    if isinstance(part, QComboBox):
        return False  # elided, and whole in its list
    hint = part.sizeHint()
    return hint.width() > part.width() + 1 or hint.height() > part.height() + 1


def _sticks_out(part: QWidget) -> bool:
    parent = part.parentWidget()
    return parent is not None and not parent.rect().contains(part.geometry())


def _meet(one: QWidget, other: QWidget) -> bool:
    return one.parentWidget() is other.parentWidget() and one.geometry().intersects(other.geometry())


def _is_foreign(part: QWidget, language: Language) -> bool:
    text = _text(part)
    return translate(text, language) != text


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
        """Make a result, and a record."""
        run = self.window.run
        self.window.open(run)
        run.form.add_programme(str(self._programme))
        run.form.serial.setText("SN-1")
        run.controls.start.click()
        self._wait(lambda: self.window.result.presentation is not None)

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
            self.settle()
            yield place.sign
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
                wrong = [*flaws(tour.window, language), *(faint(tour.window) if scale == 1.0 else [])]
                found += [f"{look}: {each}" for each in wrong]
        tour.leave()
    print("\n".join(found))
    print(f"{len(found)} flaws")
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
