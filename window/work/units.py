"""Units of which a store has records; called outside the event loop."""

from pathlib import Path


def units(folder: Path) -> tuple[str, ...]:
    """Their serial numbers, by name; none where there is no store. Raises `StoreError`."""
    from tumble.app.opening import open_store
    from tumble.calibrations.records.store import DATABASE

    return open_store(folder).serial_numbers() if (folder / DATABASE).is_file() else ()
