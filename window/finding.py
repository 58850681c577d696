"""What the finder finds: all that the window can do now, stands that were chosen lately, and units of the store."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from PySide6.QtWidgets import QMenuBar

from tumble.window.finder import sources
from tumble.window.finder.command import Command
from tumble.window.frame import Frame
from tumble.window.look.language import tr
from tumble.window.recent import recent_stands
from tumble.window.work.background import Background
from tumble.window.work.units import units


@dataclass(frozen=True, kw_only=True)
class Finding:
    """Fills the finder whenever it is opened."""

    frame: Frame
    menus: QMenuBar
    background: Background
    store: Callable[[], Path]
    open_stand: Callable[[str], None]
    """Chooses a stand by the path of its file."""
    show_unit: Callable[[str], None]
    """Shows the records of a unit, by its serial number."""

    def begin(self) -> None:
        """Offer what can be done now; units come as soon as they are read, or not at all."""
        self.frame.finder.open(self._commands())
        self.background.start(partial(units, self.store()), self._offer_units, lambda _error: None)

    def _commands(self) -> list[Command]:
        frame = self.frame
        return [
            *sources.of_actions(tr("Screen"), frame.rail.actions()),
            *(
                command
                for place, screen in zip(frame.places, frame.screens, strict=True)
                for command in sources.of_screen(place.title, screen, partial(frame.open, screen))
            ),
            *sources.of_screen(tr("Window"), frame.stop_bar, lambda: None),
            *sources.of_menus(self.menus),
            *sources.of_names(tr("Stand file"), recent_stands(), self.open_stand),
        ]

    def _offer_units(self, names: tuple[str, ...]) -> None:
        self.frame.finder.add(sources.of_names(tr("Unit under test"), names, self.show_unit))
