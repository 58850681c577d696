"""An older store seen as one of the present version, its file unchanged: it may lie in a write-protected archive.

In SQLite a temporary view hides the table of its name (sqlite.org/lang_naming.html); `main.records` is still the table.
"""

from collections.abc import Mapping

from sqlalchemy import Connection, Table

from tumble.calibrations.records.migrations.expressions import PARAMETERS_2, RECORDS_2, RECORDS_3, teach_expressions
from tumble.calibrations.records.schema import CHAINS, PARAMETERS, RECORDS


def show_as_current(connection: Connection, version: int) -> None:
    """Have the tables of an older version look like those of the present one, for this connection."""
    teach_expressions(connection)
    connection.exec_driver_sql(_view(RECORDS, RECORDS_3 | (RECORDS_2 if version == 1 else {})))
    if version == 1:
        _show_what_came_with_2(connection)


def _show_what_came_with_2(connection: Connection) -> None:
    connection.exec_driver_sql(_view(PARAMETERS, PARAMETERS_2))
    nothing = ", ".join(f"NULL AS {column.name}" for column in CHAINS.columns)
    connection.exec_driver_sql(f"CREATE TEMP VIEW {CHAINS.name} AS SELECT {nothing} WHERE 0")


def _view(table: Table, expressions: Mapping[str, str]) -> str:
    columns = ", ".join(f"{expressions.get(column.name, column.name)} AS {column.name}" for column in table.columns)
    return f"CREATE TEMP VIEW {table.name} AS SELECT {columns} FROM main.{table.name}"
