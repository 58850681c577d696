"""What settings have kept, as what it can be: whatever else a file of settings says is as if it said nothing."""

from math import isfinite

from PySide6.QtCore import QSettings


def kept_text(name: str, usual: str = "") -> str:
    """A text, or the usual one."""
    kept = QSettings().value(name, usual)
    return kept if isinstance(kept, str) else usual


def kept_place(name: str, usual: int, count: int) -> int:
    """Which of so many, counted from 0, or the usual one."""
    kept = kept_number(name, usual)
    return int(kept) if kept in range(count) else usual


def kept_number(name: str, usual: float) -> float:
    """A number, or the usual one."""
    try:
        kept = float(str(QSettings().value(name, usual)))
    except ValueError:
        return usual
    return kept if isfinite(kept) else usual
