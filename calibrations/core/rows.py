"""Rows of a table as arrays: a method declares its columns once, and everything else follows from that declaration.

Reading and writing tables, selecting, joining and averaging rows go by the declared columns; no list of them is written
down twice.
"""

from collections.abc import Mapping
from dataclasses import Field, dataclass, field, fields, replace
from enum import Enum
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray

OVERLOAD = 1e30
"""A reading beyond this is an instrument's way to say overload (SCPI-1999, volume 1, 7.2.1.5: 9.9E37 is infinity)."""
_DECLARED = "tumble"
"""Key of a column in the metadata of its field."""


class Kind(Enum):
    """What the cells of a column hold."""

    NUMBER = "number"
    WHOLE = "whole number"
    TEXT = "text"


@dataclass(frozen=True, kw_only=True)
class Column:
    """One column of a kind of table."""

    name: str = ""
    """As tables spell it, the unit at its end; empty where no table has it."""
    kind: Kind = Kind.NUMBER
    needed: bool = False
    """Whether a row without a finite value is set aside."""
    unknown: Any = None
    """Value in a row of which it is not known; None where such a row cannot be used."""
    default: Any = None
    """Value in every row of a table without the column; None where the column is then unknown."""
    choices: tuple[Any, ...] = ()
    """The values that it may have; any where there are none."""


@dataclass(frozen=True, kw_only=True)
class SetAside:
    """A row that is not used, and why."""

    row: int
    """Number of the data row, the first being 1."""
    reason: str
    gross: bool = False
    """Whether its output is a gross error, not a value that is missing or none."""


def column(
    name: str = "",
    *,
    kind: Kind = Kind.NUMBER,
    needed: bool = False,
    unknown: Any = None,  # noqa: ANN401  # any kind of value
    default: Any = None,  # noqa: ANN401
    choices: tuple[Any, ...] = (),
    required: bool = False,
) -> Any:  # noqa: ANN401  # the type of the field that it declares
    """Declare a field of `Rows` as a column; the words are those of `Column`. It may be None unless `required`."""
    declared = Column(name=name, kind=kind, needed=needed, unknown=unknown, default=default, choices=choices)
    metadata = {_DECLARED: declared}
    return field(metadata=metadata) if required else field(default=None, metadata=metadata)


@dataclass(frozen=True, kw_only=True)
class Rows:
    """Rows as arrays of equal length, in the order in which they were taken; None where the table does not say.

    A kind of table inherits from it and declares its columns with `column`. Rows that hold no measurement are already
    out and listed in `set_aside`.
    """

    settings: ClassVar[tuple[str, ...]] = ()
    """Columns, as tables spell them, without which there is no such table."""
    outputs: ClassVar[tuple[str, ...]] = ()
    """Columns of which one at least must be there."""

    row: NDArray[np.int64] = column(kind=Kind.WHOLE, required=True)
    """Number of the data row in the source, the first being 1."""
    time_s: FloatArray | None = column("time_s", needed=True)
    """Middle of the dwell, in seconds from any origin."""
    realisation: NDArray[np.int64] | None = column("realisation", kind=Kind.WHOLE, default=1)
    take: NDArray[np.int64] | None = column("take", kind=Kind.WHOLE, default=1)
    """Which taking of the dwell a row is, from 1; more where the operator had it taken again."""
    run: NDArray[np.int64] | None = column(kind=Kind.WHOLE, default=0)
    """Number of the run of each row, from 0, where several were joined."""
    extra: Mapping[str, FloatArray | NDArray[np.str_]] = field(default_factory=dict)
    """Columns that are not declared, kept as covariates."""
    set_aside: tuple[SetAside, ...] = ()
    warnings: tuple[str, ...] = ()
    """Sentences for the reader of the result: a cut file, a last line without an end."""
    complete: bool = True
    """False where the source was cut off."""
    source: str = ""
    """What to call the source in a message."""

    def __len__(self) -> int:
        """Return the number of usable rows."""
        return len(self.row)

    @property
    def rows_read(self) -> int:
        """Rows in the source, usable or not."""
        return len(self) + len(self.set_aside)

    @property
    def realisations(self) -> NDArray[np.int64]:
        """Realisation of every row; 1 where the table does not say."""
        return np.ones(len(self), dtype=np.int64) if self.realisation is None else self.realisation

    @property
    def runs(self) -> NDArray[np.int64]:
        """Run of every row; 0 where there is only one."""
        return np.zeros(len(self), dtype=np.int64) if self.run is None else self.run

    @classmethod
    def columns(cls) -> dict[str, Column]:
        """The declared columns by field, in the order of their declaration."""
        return {each.name: each.metadata[_DECLARED] for each in _declared(cls)}

    @classmethod
    def spelt(cls) -> dict[str, str]:
        """Field of each column that tables have, by its name there, in the order in which they are written."""
        return {each.name: field for field, each in cls.columns().items() if each.name}

    def values(self, name: str) -> NDArray[Any] | None:
        """Values of a declared column, by its field, or of one of `extra`; None where there are none."""
        return getattr(self, name) if name in self.columns() else self.extra.get(name)

    def over(self, rows: NDArray[np.int64] | NDArray[np.bool_]) -> Self:
        """Return these rows, by number or by a mask, in this order; what is set aside stays listed."""
        taken: dict[str, Any] = {
            name: None if (values := getattr(self, name)) is None else values[rows] for name in self.columns()
        }
        return replace(self, **taken, extra={name: values[rows] for name, values in self.extra.items()})

    def select(self, keep: NDArray[np.bool_]) -> Self:
        """Return the rows for which `keep` is true; what is set aside stays listed."""
        return self.over(keep)

    def without(self, rejected: tuple[SetAside, ...]) -> Self:
        """Return the table without the rows in `rejected`, which join `set_aside`."""
        keep = ~np.isin(self.row, [entry.row for entry in rejected])
        aside = tuple(sorted((*self.set_aside, *rejected), key=lambda entry: entry.row))
        return replace(self.select(keep), set_aside=aside)

    def lasting(self, count: int) -> Self:
        """Return `count` rows that repeat the last one; none is set aside."""
        return replace(self.over(np.full(count, len(self) - 1)), set_aside=())

    def averaged(self, number: NDArray[np.int64]) -> Self:
        """Return one row for each group, numbered from 0: means of numbers, the first of everything else."""
        first, counts = np.unique(number, return_index=True)[1], np.bincount(number)
        means: dict[str, Any] = {
            name: np.bincount(number, weights=values) / counts
            for name in self.columns()
            if (values := getattr(self, name)) is not None and values.dtype.kind == "f"
        }
        return replace(self.over(first), **means)


def _declared(cls: type[Rows]) -> tuple[Field[Any], ...]:
    return tuple(each for each in fields(cls) if _DECLARED in each.metadata)
