"""Calibration records: immutable, traceable to the raw file, kept in a folder with an SQLite database.

- `store.Store`: opens a folder of records, adds to it, finds records in it.
- `record.Record`: one record; `record.Verdict`: how it stands against the limits of its programme.
- `verify.verify`: whether file and record are untouched and the numbers come back from the raw file.
- `compare.compare`: what changed from one record to another, and whether that is significant.
- `export.document`, `export.document_text`: a record as JSON (`tumble.record/2`); `export.is_intact` checks one.
- `raw.file_sha256`: the hash that ties a record to its raw file.
- `errors.StoreError`, `errors.RecordError`: what goes wrong.
- `schema.METADATA`: the tables, for SQLite and PostgreSQL.

Nothing is imported here, so that `errors` comes without SQLAlchemy.
"""

DATABASE = "records.sqlite"
"""Name of the database in the folder of a store."""
