"""What can be found."""

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Command:
    """Something that the window can do now."""

    group: str
    """Where it belongs: a screen, a menu."""
    title: str
    do: Callable[[], None]
    key: str = ""
    """The key that does the same; empty where there is none."""
    moves: bool = False
    """Whether it starts motion, so that Enter alone, which a scanner types, must not do it."""

    @property
    def name(self) -> str:
        """What is searched and shown."""
        return f"{self.group}: {self.title}"
