"""What is to be said of a recording before its points are used."""

from collections.abc import Iterator, Sequence

from tumble.messages import Message
from tumble.procedures.events import FinishReason, WarningRaised
from tumble.procedures.recording.recorded import Recording

_TOLD = 5
"""So many damages or missing points are named."""


def warnings(recording: Recording) -> Iterator[str]:
    """Yield the warnings of the run itself, then what a file that was cut off or damaged lacks."""
    yield from (event.message for event in recording.events if isinstance(event, WarningRaised))
    kept = Message.counted(
        "its {count} complete point is used", "its {count} complete points are used", count=len(recording.points)
    )
    if recording.damage:
        yield Message("{path} is damaged: {some}; {kept}", path=recording.path, some=_some(recording.damage), kept=kept)
    elif not recording.closed:
        yield Message("{path} was cut off or damaged; {kept}", path=recording.path, kept=kept)
    elif recording.ending is None:
        yield Message("{path} holds no end of the run; {kept}", path=recording.path, kept=kept)
    if recording.missing:
        yield Message(
            "{path} lacks {listed}, recorded before others that are there; {kept}",
            path=recording.path,
            listed=_listed(recording.missing),
            kept=kept,
        )
    if recording.ending is not None and recording.ending.reason is not FinishReason.COMPLETED:
        yield Message(
            "{path} holds a run that ended early ({reason}); {kept}",
            path=recording.path,
            reason=Message.marked(recording.ending.reason),
            kept=kept,
        )


def _listed(missing: Sequence[int]) -> str:
    return Message.counted(
        "point {points} (counted from 0)",
        "{count} points, {points} (counted from 0)",
        count=len(missing),
        points=_some([str(index) for index in missing]),
    )


def _some(clauses: Sequence[str]) -> str:
    """The first few, and how many more there are."""
    more = [Message("and {count} more", count=len(clauses) - _TOLD)] if len(clauses) > _TOLD else []
    return Message.joined(", ", [*clauses[:_TOLD], *more])
