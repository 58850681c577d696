"""Stores of older versions: `view` reads them as they are, `running` brings them to the version of the program.

`versions` are scripts of Alembic, one a version. Which version a store has, its table `store` says; Alembic's own
table of versions and its configuration file are not used. See `docs/decisions/0009-store-migrations.md`.
"""
