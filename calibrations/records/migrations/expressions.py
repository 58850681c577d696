"""What the columns of one version are in terms of those of the version before, for SQLite.

The view through which an old store is read and the migration use the same expressions.
"""

import sqlite3
from collections.abc import Callable
from dataclasses import asdict

from sqlalchemy import Connection

from tumble.calibrations.core.provenance import LimitCheck
from tumble.calibrations.records.canonical import canonical_text, read_json
from tumble.calibrations.records.findings import text_of
from tumble.calibrations.records.old_formats import outcome_of, sources_of, unsaid, verdict_of

RECORDS_2 = {
    "method": "unsaid_method()",
    "method_version": "unsaid_method_version()",
    "sources": "sources_of(raw_path, raw_sha256)",
    "outcome": "outcome_of(verdict)",
    "verdict": "verdict_of(result, limits)",
    "models": "NULL",
    "writer": "NULL",
    "sequence": "NULL",
    "previous_sha256": "NULL",
}
PARAMETERS_2 = {"given": "given_of(given_alpha0_deg)"}
"""Name in version 2, expression in version 1."""
RECORDS_3 = {"lot": "''", "findings": "findings_in(result)"}
"""Name in version 3, expression in version 2 or 1."""


def teach_expressions(connection: Connection) -> None:
    """Have a connection know the functions in the expressions."""
    sqlite: sqlite3.Connection = connection.connection.driver_connection  # type: ignore[assignment]
    sqlite.create_function("unsaid_method", 0, lambda: unsaid().method)
    sqlite.create_function("unsaid_method_version", 0, lambda: unsaid().method_version)
    sqlite.create_function("sources_of", 2, _or_null(_sources))
    sqlite.create_function("outcome_of", 1, _or_null(_outcome))
    sqlite.create_function("verdict_of", 2, _or_null(_verdict))
    sqlite.create_function("given_of", 1, _or_null(_given))
    sqlite.create_function("findings_in", 1, _or_null(_findings))


def _sources(raw_path: str, raw_sha256: str) -> str:
    return canonical_text([asdict(source) for source in sources_of(raw_path, raw_sha256)])


def _outcome(word: str) -> str:
    return str(outcome_of(word))


def _verdict(result: str, limits: str) -> str:
    checks = [LimitCheck(**check) for check in read_json(limits)]
    return canonical_text(verdict_of(read_json(result), checks).as_json())


def _findings(result: str) -> str:
    return text_of(read_json(result))


def _given(value: float) -> str:
    return canonical_text({unsaid().condition: value})


def _or_null(function: Callable[..., str]) -> Callable[..., str | None]:
    """Nothing where there is nothing, or where a record is damaged: verifying that record says so."""

    def tried(*stored: str | float | None) -> str | None:
        try:
            return None if None in stored else function(*stored)
        except (AttributeError, KeyError, TypeError, ValueError):
            return None

    return tried
