"""A raw file as the analysis needs it, recording or table alike."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Self, TypeVar

from pydantic import ValidationError

from tumble.app.stand import RecordedStand, Site
from tumble.calibrations.adopted.effect import AdoptedEffect
from tumble.calibrations.core.provenance import Source
from tumble.calibrations.core.rows import Rows
from tumble.calibrations.records.raw import stored_path
from tumble.calibrations.stand_records.record import StandRecord
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.procedures.programme import Programme
from tumble.procedures.programmes import programme_from_text
from tumble.procedures.recording.header import Header

_S = TypeVar("_S", bound=RecordedStand)


@dataclass(frozen=True, kw_only=True)
class Measurement:
    """A raw file: its rows, and what it says of itself."""

    path: Path
    sha256: str
    method: str
    """Name of the method that analyses it."""
    observations: Rows
    stand: Mapping[str, Any]
    """The stand file as data, without what is simulated; empty for a table."""
    header: Header | None = None
    """None for a table."""
    lot: str = ""
    """In which the unit was made; empty where nobody said so."""
    others: tuple["Measurement", ...] = ()
    """Further files whose rows are in `observations` too."""
    serials: Mapping[str, str] = field(default_factory=dict)
    """What head and DAQ said of themselves when they were identified."""
    stand_record: StandRecord | None = None
    """What the rows were corrected by."""
    adopted: tuple[AdoptedEffect, ...] = ()
    """Effects of the laboratory's own that are sought in it beside those of the method."""

    def of_lot(self, lot: str) -> Self:
        """The same of a unit of another lot, where one is named."""
        return replace(self, lot=lot) if lot else self

    def source(self, folder: Path) -> Source:
        """The file as records name it, its path relative to a folder if it lies in it."""
        kind = "recording" if self.header else "table"
        return Source(kind=kind, path=stored_path(folder, self.path), sha256=self.sha256)

    @property
    def reference_temperature_degc(self) -> float:
        """Temperature to which parameters refer; 23 °C where there is no stand file. Raises `InputError`."""
        file = self.stand_as(RecordedStand)
        return (file.site if file else Site()).reference_temperature_degc

    @property
    def uses_stand_record(self) -> bool:
        """Whether its stand file wants stored corrections to be applied. Raises `InputError`."""
        file = self.stand_as(RecordedStand)
        return file is not None and file.stand_record.use

    def stand_as(self, schema: type[_S]) -> _S | None:
        """The stand file by a schema, with what a method needs of it; None where there is none. Raises `InputError`."""
        if not self.stand:
            return None
        try:
            return schema.model_validate(self.stand)
        except ValidationError as error:
            first = error.errors()[0]
            where = ".".join(map(str, first["loc"]))
            raise InputError(
                Message(
                    "{path}: the stand file in it does not fit: {where}: {mistake}; give one with --stand",
                    path=self.path,
                    where=where,
                    mistake=first["msg"],
                )
            ) from error

    @property
    def programme(self) -> Programme | None:
        """The programme that was run; None for a table. Raises `ProgrammeError`."""
        return programme_from_text(self.header.programme_text, str(self.path)) if self.header else None
