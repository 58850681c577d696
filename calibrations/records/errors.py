"""What can go wrong with records."""

from pathlib import Path

from tumble.messages import Message


class StoreError(Exception):
    """The store cannot be opened, read or written. Nothing is half-written.

    The message is one sentence for the operator: which file, what happened, what to do.
    """

    def __init__(self, path: Path, happened: str, remedy: str) -> None:
        super().__init__(Message("{path}: {happened}; {remedy}", path=path, happened=happened, remedy=remedy))
        self.path = path
        self.happened = happened
        self.remedy = remedy


class RecordError(ValueError):
    """What was asked for does not fit the records: none of that name, several, or one that may not be revised so."""
