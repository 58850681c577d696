"""Times in records: UTC, as ISO 8601 texts of one length, which sort as the times do on every database."""

from datetime import UTC, datetime

from tumble.messages import Message


def utc_now() -> datetime:
    """Time of the computer's clock."""
    return datetime.now(UTC)


def utc_text(time: datetime) -> str:
    """Write a time as `2026-11-22T14:15:03.123456Z`.

    Raises
    ------
    ValueError
        For a time without time zone.
    """
    if time.tzinfo is None:
        raise ValueError(Message("{time} has no time zone; add one, for example {time}Z", time=time.isoformat()))
    return time.astimezone(UTC).isoformat(timespec="microseconds").removesuffix("+00:00") + "Z"


def read_time(text: str) -> datetime:
    """Read an ISO 8601 text."""
    return datetime.fromisoformat(text)
