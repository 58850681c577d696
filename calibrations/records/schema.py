"""Tables of the store, the same for SQLite and PostgreSQL.

The JSON columns of `records` hold everything; the other columns, and the table `parameters`, repeat parts of them for
queries and for trends over units and time. Times are UTC as ISO 8601 texts (see `times`). Columns that came with a
later version may be null in the database, which cannot add others; the program always fills them.
"""

from sqlalchemy import (
    JSON,
    Boolean,
    Column,
    Double,
    ForeignKey,
    Index,
    Integer,
    MetaData,
    String,
    Table,
    UniqueConstraint,
)

from tumble.calibrations.records.immutability import protect

STORE_VERSION = 3
"""Of the tables below. A store with a newer one is not opened; an older one is read, and migrated when it is written.

Version 1 knew one method and no chains, version 2 could not be searched for lots and effects.
"""

METADATA = MetaData()

RECORD_KEYS = (("id",), ("supersedes",), ("writer", "sequence"))

STORE = Table("store", METADATA, Column("version", Integer, primary_key=True, autoincrement=False))
"""One row: the version of the tables."""

RECORDS = Table(
    "records",
    METADATA,
    Column("id", String, primary_key=True),
    Column("format_version", Integer, nullable=False),
    Column("revision", Integer, nullable=False),
    # Unique: of two revisions of one record nobody could say which one stands.
    Column("supersedes", ForeignKey("records.id"), unique=True),
    Column("created_at", String, nullable=False),
    Column("serial_number", String, nullable=False, index=True),
    Column("operator", String, nullable=False),
    Column("programme_name", String, nullable=False),
    Column("programme_sha256", String, nullable=False),
    Column("stand_name", String, nullable=False),
    Column("measured_at", String),
    Column("program_version", String, nullable=False),
    Column("git_commit", String, nullable=False),
    Column("git_dirty", Boolean, nullable=False),
    Column("complete", Boolean, nullable=False),
    Column("limits", JSON, nullable=False),
    Column("provenance", JSON, nullable=False),
    Column("result", JSON, nullable=False),
    Column("content_sha256", String, nullable=False),
    Column("method", String),
    Column("method_version", Integer),
    Column("sources", JSON),
    Column("outcome", String),  # of the verdict
    Column("verdict", JSON),
    Column("models", JSON(none_as_null=True)),  # null up to format 3
    Column("writer", String),  # null up to format 3, as the next two
    Column("sequence", Integer),
    Column("previous_sha256", String),
    Column("lot", String, index=True),
    Column("findings", String),  # see `findings.text_of`
    Index("ix_records_writer_sequence", "writer", "sequence", unique=True),
)

PARAMETERS = Table(
    "parameters",
    METADATA,
    Column("record_id", ForeignKey("records.id"), primary_key=True),
    Column("model", String, primary_key=True),  # `declared`, or `augmented`: with the effects found
    Column("name", String, primary_key=True),
    Column("unit", String, nullable=False),
    Column("value", Double),
    Column("standard_uncertainty", Double),
    Column("type_a", Double),
    Column("degrees_of_freedom", Double),  # null: infinite, or no value
    Column("lower_95", Double),
    Column("upper_95", Double),
    Column("reason", String, nullable=False),
    Column("given", JSON(none_as_null=True)),  # values of other parameters for which this one stands
)

CHAINS = Table(
    "chains",
    METADATA,
    Column("writer", String, primary_key=True),
    Column("place", String, nullable=False),  # user, computer and folder
    Column("sequence", Integer, nullable=False),
    Column("content_sha256", String, nullable=False),
)
"""The last record of every writer. The only rows that change."""

STAND_RECORDS = Table(
    "stand_records",
    METADATA,
    Column("id", String, primary_key=True),
    Column("stand", String, nullable=False),
    Column("head", String, nullable=False),
    Column("daq", String, nullable=False),
    Column("version", Integer, nullable=False),
    Column("status", String, nullable=False),
    Column("content", JSON, nullable=False),
    Column("content_sha256", String, nullable=False),
    UniqueConstraint("stand", "head", "daq", "version"),
)
"""What is known of the stands. It came later: a store without it gets it with its first stand record."""

protect(RECORDS, keys=RECORD_KEYS)
protect(PARAMETERS, keys=(("record_id", "model", "name"),))
protect(STAND_RECORDS, keys=(("id",), ("stand", "head", "daq", "version")))
