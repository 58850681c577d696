"""What can go wrong with a recording."""

from pathlib import Path

from tumble.messages import Message


class RecordingError(Exception):
    """A recording cannot be written, or cannot be read.

    The message is one sentence for the operator: which file, what happened, what to do.
    """

    def __init__(self, path: Path, happened: str, remedy: str) -> None:
        super().__init__(Message("{path}: {happened}; {remedy}", path=path, happened=happened, remedy=remedy))
        self.path = path
        self.happened = happened
        self.remedy = remedy
