"""The store as version 0.1 of the program made it: nothing led to it."""

revision = "1"
down_revision = None


def upgrade() -> None:
    """Do nothing."""
