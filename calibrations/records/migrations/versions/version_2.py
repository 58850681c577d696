"""Records of any method, of several raw files, chained by hash.

Columns are added and dropped in place: a table made anew would number its rows anew, and hide what was deleted.
"""

from alembic import op
from sqlalchemy import JSON, Column, Integer, String

from tumble.calibrations.records.migrations.expressions import PARAMETERS_2, RECORDS_2, teach_expressions
from tumble.calibrations.records.migrations.unprotected import unprotected

revision = "2"
down_revision = "1"

_RECORD_KEYS = (("id",), ("supersedes",), ("writer", "sequence"))
_PARAMETER_KEYS = (("record_id", "model", "name"),)
_NEW = (
    Column("method", String),
    Column("method_version", Integer),
    Column("sources", JSON),
    Column("outcome", String),
    Column("verdict_2", JSON),
    Column("models", JSON),
    Column("writer", String),
    Column("sequence", Integer),
    Column("previous_sha256", String),
)


def upgrade() -> None:
    """Add the columns, fill them, drop those that they take the place of."""
    teach_expressions(op.get_bind())
    with unprotected({"records": _RECORD_KEYS, "parameters": _PARAMETER_KEYS}):
        _change_records()
        _change_parameters()
    op.create_table(
        "chains",
        Column("writer", String, primary_key=True),
        Column("place", String, nullable=False),
        Column("sequence", Integer, nullable=False),
        Column("content_sha256", String, nullable=False),
    )


def _change_records() -> None:
    for column in _NEW:
        op.add_column("records", column)
    expressions = {{"verdict": "verdict_2"}.get(name, name): said for name, said in RECORDS_2.items()}
    _fill("records", expressions)
    for name in ("raw_path", "raw_sha256", "verdict"):
        op.drop_column("records", name)
    op.alter_column("records", "verdict_2", new_column_name="verdict")
    op.create_index("ix_records_writer_sequence", "records", ["writer", "sequence"], unique=True)


def _change_parameters() -> None:
    op.add_column("parameters", Column("given", JSON))
    _fill("parameters", PARAMETERS_2)
    op.drop_column("parameters", "given_alpha0_deg")


def _fill(table: str, expressions: dict[str, str]) -> None:
    op.execute(f"UPDATE {table} SET " + ", ".join(f"{name} = {said}" for name, said in expressions.items()))
