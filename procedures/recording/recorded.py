"""What a recording holds once it is read."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tumble.procedures.events import ConditionAnswered, FinishReason, ReadingAnswered, RunFinished
from tumble.procedures.recording.header import Header
from tumble.procedures.recording.messages import Announcement
from tumble.procedures.steps import Point, Step


@dataclass(frozen=True, kw_only=True)
class Recording:
    """A recording without its samples, up to the end of the file or to where it breaks off."""

    path: Path
    header: Header
    points: tuple[Point, ...]
    """Completed points by index, each once: of one that was taken again the latest take."""
    steps: tuple[Step, ...]
    """Steps that were begun, in order."""
    answers: tuple[ConditionAnswered | ReadingAnswered, ...]
    events: tuple[Announcement, ...]
    """States, prompts, warnings and the end, in order."""
    closed: bool
    """Whether the file is whole, footer included; false where it was cut off or damaged."""
    damage: tuple[str, ...] = ()
    """What in it is not as it was written, as clauses; a file that was merely cut off has none."""

    @property
    def missing(self) -> tuple[int, ...]:
        """Numbers of points that are not there although later ones are: they were lost, for none is left out."""
        return (
            tuple(sorted(set(range(self.points[-1].index)) - {point.index for point in self.points}))
            if self.points
            else ()
        )

    @property
    def takes(self) -> NDArray[np.int64] | None:
        """How often each point was taken; None where none was taken again, as tables leave it out then."""
        takes = np.array([point.take for point in self.points], dtype=np.int64)
        return takes if (takes > 1).any() else None

    @property
    def ending(self) -> RunFinished | None:
        """How the run ended, where it was resumed the last time; None where the recording breaks off before."""
        last = self.events[-1] if self.events else None
        return last if isinstance(last, RunFinished) else None

    @property
    def finished(self) -> bool:
        """Whether the run came to an end, of whatever kind, and said so."""
        return self.ending is not None

    @property
    def complete(self) -> bool:
        """Whether the file is whole and the run carried out its programme to the last step."""
        ended = self.ending is not None and self.ending.reason is FinishReason.COMPLETED
        return self.closed and ended and not self.missing
