"""The migrations of a store, carried out by Alembic."""

from pathlib import Path

from alembic.migration import MigrationContext
from alembic.operations import Operations
from alembic.script import ScriptDirectory
from sqlalchemy import Connection, update

from tumble.calibrations.records.schema import STORE, STORE_VERSION

_SCRIPTS = Path(__file__).parent


def bring_up_to_date(connection: Connection, version: int) -> None:
    """Carry out what leads from a version to `STORE_VERSION`, in the transaction of the caller."""
    scripts = ScriptDirectory(str(_SCRIPTS))
    newest_first = scripts.iterate_revisions(str(STORE_VERSION), str(version))
    with Operations.context(MigrationContext.configure(connection)):
        for script in reversed(list(newest_first)):
            script.module.upgrade()
    connection.execute(update(STORE).values(version=STORE_VERSION))
