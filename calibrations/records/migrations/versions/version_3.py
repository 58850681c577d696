"""Records that can be searched for the lot of their unit and for what was found in them."""

from alembic import op
from sqlalchemy import Column, String

from tumble.calibrations.records.migrations.expressions import RECORDS_3, teach_expressions
from tumble.calibrations.records.migrations.unprotected import unprotected

revision = "3"
down_revision = "2"

_KEYS = (("id",), ("supersedes",), ("writer", "sequence"))


def upgrade() -> None:
    """Add the columns and fill them."""
    teach_expressions(op.get_bind())
    with unprotected({"records": _KEYS}):
        for name in RECORDS_3:
            op.add_column("records", Column(name, String))
        op.execute("UPDATE records SET " + ", ".join(f"{name} = {said}" for name, said in RECORDS_3.items()))
    op.create_index("ix_records_lot", "records", ["lot"])
