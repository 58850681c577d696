"""Stand files that were chosen lately."""

from pathlib import Path
from typing import Final

from PySide6.QtCore import QSettings

_NAME: Final = "stand/recent"
_KEPT: Final = 12


def recent_stands() -> list[str]:
    """Their paths, the last one first; those that are gone are left out."""
    return [path for path in _kept() if Path(path).is_file()]


def remember_stand(path: Path) -> None:
    """Put a stand file before the others."""
    name = str(path.resolve())
    QSettings().setValue(_NAME, [name, *(each for each in _kept() if each != name)][:_KEPT])


def _kept() -> list[str]:
    kept = QSettings().value(_NAME)
    several = kept if isinstance(kept, list) else [kept]  # a list of one is a text
    return [each for each in several if isinstance(each, str)]
