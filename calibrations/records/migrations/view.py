"""A store of version 1 seen as one of version 2, its file unchanged: it may lie in an archive that cannot be written.

In SQLite a temporary view hides the table of its name (sqlite.org/lang_naming.html); `main.records` is still the table.
"""

from collections.abc import Mapping

from sqlalchemy import Connection, Table

from tumble.calibrations.records.migrations.expressions import PARAMETER_COLUMNS, RECORD_COLUMNS, teach_expressions
from tumble.calibrations.records.schema import CHAINS, PARAMETERS, RECORDS


def show_as_current(connection: Connection) -> None:
    """Have the tables of version 1 look like those of version 2, for this connection."""
    teach_expressions(connection)
    connection.exec_driver_sql(_view(RECORDS, RECORD_COLUMNS))
    connection.exec_driver_sql(_view(PARAMETERS, PARAMETER_COLUMNS))
    nothing = ", ".join(f"NULL AS {column.name}" for column in CHAINS.columns)
    connection.exec_driver_sql(f"CREATE TEMP VIEW {CHAINS.name} AS SELECT {nothing} WHERE 0")


def _view(table: Table, expressions: Mapping[str, str]) -> str:
    columns = ", ".join(f"{expressions.get(column.name, column.name)} AS {column.name}" for column in table.columns)
    return f"CREATE TEMP VIEW {table.name} AS SELECT {columns} FROM main.{table.name}"
