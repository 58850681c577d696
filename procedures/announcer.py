"""Passing events on: first to the sink, which must not fail, then to listeners, which may."""

from collections.abc import Callable, Iterable
from contextlib import suppress
from typing import Protocol, TypeAlias

from tumble.messages import Message
from tumble.procedures.errors import StorageError
from tumble.procedures.events import Event, WarningRaised

Listener: TypeAlias = Callable[[Event], None]
"""Is called with every event, in the thread of the run, after the sink has taken it."""


class Sink(Protocol):
    """What keeps the events of a run."""

    def record(self, event: Event) -> str | None:
        """Take an event; when this returns from a `PointCompleted`, the point is safe.

        Returns a sentence where something had to be put right for that. Whatever is raised ends the run.
        """
        ...


class Announcer:
    """Passes events on. A listener that fails is dropped with a warning; a sink that fails is a `StorageError`."""

    def __init__(self, sink: Sink, listeners: Iterable[Listener]) -> None:
        self._sink = sink
        self._listeners = list(listeners)

    def announce(self, event: Event) -> None:
        """Pass `event` on. Raises `StorageError`, and no listener hears of what could not be stored."""
        remark = self.store(event)
        for sentence in (*self.tell(event), *([remark] if remark else [])):
            self.announce(WarningRaised(message=sentence))

    def announce_anyway(self, event: Event) -> None:
        """Pass `event` on to the listeners even where the sink fails."""
        with suppress(StorageError):
            self.store(event)
        self.tell(event)

    def store(self, event: Event) -> str | None:
        """Give `event` to the sink alone; returns what that says. Raises `StorageError`."""
        try:
            return self._sink.record(event)
        except Exception as error:
            what = str(error) or type(error).__name__
            raise StorageError(Message("the recording failed: {what}; then resume the run", what=what)) from error

    def tell(self, event: Event) -> list[str]:
        """Call every listener; drop those that fail and return a sentence on each."""
        failures: list[str] = []
        for listener in tuple(self._listeners):
            try:
                listener(event)
            except Exception as error:  # whatever it is, watching must not end a run
                self._listeners.remove(listener)
                name = getattr(listener, "__qualname__", type(listener).__name__)
                failures.append(
                    Message(
                        "the display {name} failed and is no longer served: {kind}: {error}",
                        name=name,
                        kind=type(error).__name__,
                        error=error,
                    )
                )
        return failures
