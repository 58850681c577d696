"""What is to be said of a recording before its points are used."""

from collections.abc import Iterator, Sequence

from tumble.procedures.events import FinishReason, WarningRaised
from tumble.procedures.recording.reader import Recording

_TOLD = 5
"""So many damages or missing points are named."""


def warnings(recording: Recording) -> Iterator[str]:
    """Yield the warnings of the run itself, then what a file that was cut off or damaged lacks."""
    yield from (event.message for event in recording.events if isinstance(event, WarningRaised))
    kept = f"its {len(recording.points)} complete points are used"
    if recording.damage:
        yield f"{recording.path} is damaged: {_some(recording.damage)}; {kept}"
    elif not recording.closed:
        yield f"{recording.path} was cut off or damaged; {kept}"
    elif recording.ending is None:
        yield f"{recording.path} holds no end of the run; {kept}"
    if recording.missing:
        yield f"{recording.path} lacks {_listed(recording.missing)}, recorded before others that are there; {kept}"
    if recording.ending is not None and recording.ending.reason is not FinishReason.COMPLETED:
        yield f"{recording.path} holds a run that ended early ({recording.ending.reason}); {kept}"


def _listed(missing: Sequence[int]) -> str:
    points = "point" if len(missing) == 1 else f"{len(missing)} points,"
    return f"{points} {_some([str(index) for index in missing])} (counted from 0)"


def _some(clauses: Sequence[str]) -> str:
    """The first few, and how many more there are."""
    more = [f"and {len(clauses) - _TOLD} more"] if len(clauses) > _TOLD else []
    return ", ".join([*clauses[:_TOLD], *more])
