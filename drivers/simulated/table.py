"""What the table `[simulated]` of every kind of world has in common."""

from typing import Final

from pydantic import BaseModel, ConfigDict, Field

FIRST_WORLD: Final = "head"
"""The world of a table that names none: a head and a DAQ."""


class Table(BaseModel):
    """A table of the stand file: no unknown key, no change after reading."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class SimulatedTable(Table):
    """Which world it is, and the seed of everything random in it."""

    world: str = FIRST_WORLD
    seed: int = Field(default=1, ge=0, lt=2**64)

    @property
    def code(self) -> tuple[str, ...]:
        """Python files that the table names, as `FILE.py:NAME`."""
        return ()
