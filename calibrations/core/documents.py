"""Parts that every result document has."""

from typing import Any

from tumble.calibrations.core.rows import Rows, SetAside


def rows_json(rows: Rows) -> dict[str, Any]:
    """Rows read, used and set aside, as the result formats have them."""
    return {
        "read": rows.rows_read,
        "used": len(rows),
        "set_aside": [_aside_json(entry) for entry in rows.set_aside],
    }


def _aside_json(entry: SetAside) -> dict[str, Any]:
    return {"row": entry.row, "reason": entry.reason}
