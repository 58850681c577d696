"""Triggers that refuse to change or delete what is recorded, whichever program tries.

They stop mistakes. Against intent, which could drop them, stands the hash in every record (`verify`).
"""

from collections.abc import Sequence

from sqlalchemy import DDL, Table, event

MESSAGE = "calibration records are immutable: add a revision instead"

_SQLITE_REFUSE = f"BEGIN SELECT RAISE(ABORT, '{MESSAGE}'); END"

_POSTGRESQL_FUNCTION = f"""
CREATE OR REPLACE FUNCTION refuse_change() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    RAISE EXCEPTION '{MESSAGE}';
END
$$
"""


def protect(table: Table, keys: Sequence[Sequence[str]]) -> None:
    """Have the triggers made together with the table.

    `keys` are its unique keys: in SQLite, INSERT OR REPLACE deletes a row of equal key and fires no delete trigger.
    """
    statements = {
        "sqlite": sqlite_triggers(table.name, keys),
        "postgresql": [_POSTGRESQL_FUNCTION, *_postgresql_triggers(table.name)],
    }
    for dialect, listed in statements.items():
        for statement in listed:
            ddl: DDL = DDL(statement)  # type: ignore[no-untyped-call]
            event.listen(table, "after_create", ddl.execute_if(dialect=dialect))


def sqlite_triggers(table: str, keys: Sequence[Sequence[str]]) -> list[str]:
    """The statements that make the triggers of a table in SQLite."""
    return [*_sqlite_changes(table), *_sqlite_replacements(table, keys)]


def _sqlite_changes(table: str) -> list[str]:
    return [
        f"CREATE TRIGGER {table}_no_{action} BEFORE {action} ON {table} {_SQLITE_REFUSE}"
        for action in ("update", "delete")
    ]


def _sqlite_replacements(table: str, keys: Sequence[Sequence[str]]) -> list[str]:
    equal = " OR ".join(" AND ".join(f"{column} = NEW.{column}" for column in key) for key in keys)
    return [
        f"CREATE TRIGGER {table}_no_replace BEFORE INSERT ON {table} "
        f"WHEN EXISTS (SELECT 1 FROM {table} WHERE {equal}) {_SQLITE_REFUSE}"
    ]


def _postgresql_triggers(table: str) -> list[str]:
    return [
        f"CREATE TRIGGER {table}_no_change BEFORE UPDATE OR DELETE ON {table} "
        "FOR EACH ROW EXECUTE FUNCTION refuse_change()",
        f"CREATE TRIGGER {table}_no_truncate BEFORE TRUNCATE ON {table} "
        "FOR EACH STATEMENT EXECUTE FUNCTION refuse_change()",
    ]
