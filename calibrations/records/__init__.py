"""Records of results of any method: immutable, traceable to the raw files, kept in a folder with an SQLite database.

- `store.Store`: opens a folder of records, adds to it, finds records in it.
- `entry.Entry`: a result as it is given to `Store.add`, with its method, its parameters and its verdict.
- `record.Record`: one record; `parameter.RecordedParameter`: one of its parameters.
- `verify.verify`: whether files and record are untouched and the numbers come back from the raw files.
- `chain.chains`: whether records were deleted or altered past the triggers.
- `compare.compare`: what changed from one record to another, and whether that is significant.
- `export.document`, `export.document_text`: a record as JSON (`tumble.record/5`); `export.is_intact` checks one.
- `raw.file_sha256`: the hash that ties a record to a raw file.
- `errors.StoreError`, `errors.RecordError`: what goes wrong.
- `schema.METADATA`: the tables, for SQLite and PostgreSQL; `migrations`: stores of older versions.
- `old_formats`: how records of older formats are read.

Nothing is imported here, so that `errors` comes without SQLAlchemy.
"""

DATABASE = "records.sqlite"
"""Name of the database in the folder of a store."""
