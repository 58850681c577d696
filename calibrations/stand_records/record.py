"""One stand record: what is known of a stand, from which units, and where it holds."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from datetime import datetime
from enum import StrEnum
from typing import Any

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.budget import Source
from tumble.calibrations.core.sentences import series
from tumble.calibrations.records.canonical import canonical_sha256, plain
from tumble.calibrations.records.times import read_time, utc_text
from tumble.calibrations.stand_records.corrections import Corrections, corrections_from_json
from tumble.messages import Message

FORMAT_VERSION = 1


class Status(StrEnum):
    """Whether a record is applied."""

    PROVISIONAL = "provisional"
    """One unit says so: shown, not applied."""
    IN_FORCE = "in force"
    """Units agree on it."""

    @property
    def words(self) -> Message:
        """The same for a reader."""
        return Message("in force") if self is Status.IN_FORCE else Message("provisional")


@dataclass(frozen=True, kw_only=True)
class StandIdentity:
    """To what a record belongs: another head or another voltmeter at the same stand is another stand."""

    stand: str
    head: str
    """Driver and serial number."""
    daq: str


@dataclass(frozen=True, kw_only=True)
class Contribution:
    """One unit that a record was derived from, and what it says alone."""

    serial_number: str
    raw_paths: tuple[str, ...]
    """Its files, relative to the store where they lie inside."""
    raw_sha256: tuple[str, ...]
    measured_at: str
    """Start of the run, ISO 8601; empty where the file does not say."""
    stand: Mapping[str, Any]
    """The stand file as data, without what is simulated."""
    coefficients: tuple[float, ...]
    """Of the terms of the record that this unit tells, in their order."""
    standard_uncertainties: tuple[float, ...]


@dataclass(frozen=True, kw_only=True)
class Validity:
    """The ranges that were measured when a record was derived; None where the data does not say."""

    angle_deg: tuple[float, float]
    voltage_v: tuple[float, float] | None = None
    temperature_degc: tuple[float, float] | None = None
    measured_from: str = ""
    measured_to: str = ""

    def together(self, other: "Validity") -> "Validity":
        """The ranges of both."""
        dates = sorted({*self._dates, *other._dates})
        temperatures = [each.temperature_degc for each in (self, other) if each.temperature_degc]
        voltages = [each.voltage_v for each in (self, other) if each.voltage_v]
        return Validity(
            angle_deg=_hull(self.angle_deg, other.angle_deg),
            voltage_v=_hull(*voltages) if voltages else None,
            temperature_degc=_hull(*temperatures) if temperatures else None,
            measured_from=dates[0] if dates else "",
            measured_to=dates[-1] if dates else "",
        )

    def exceeded_by(self, measured: "Validity") -> list[str]:
        """What of a table lies beyond, as parts of a sentence; `measured` is over what it was measured."""
        whole_turn = self.angle_deg[1] - self.angle_deg[0] >= 345.0
        pairs = {
            "°": (None if whole_turn else self.angle_deg, measured.angle_deg),
            " V": (self.voltage_v, _within(measured.voltage_v, 0.05)),
            " °C": (self.temperature_degc, _within(measured.temperature_degc, 2.0)),
        }
        return [
            Message("{range}, known for {known}", range=_range(now, unit), known=_range(known, unit))
            for unit, (known, now) in pairs.items()
            if known and now and (now[0] < known[0] or now[1] > known[1])
        ]

    @property
    def _dates(self) -> list[str]:
        return [date for date in (self.measured_from, self.measured_to) if date]


def _hull(*ranges: tuple[float, float]) -> tuple[float, float]:
    return min(low for low, _ in ranges), max(high for _, high in ranges)


def _range(ends: tuple[float, float], unit: str) -> str:
    return f"{ends[0]:.4g} to {ends[1]:.4g}{unit}"


def _within(measured: tuple[float, float] | None, margin: float) -> tuple[float, float] | None:
    """A range without its margins: noise and a breath of air are no other conditions."""
    return (measured[0] + margin, measured[1] - margin) if measured else None


@dataclass(frozen=True, kw_only=True)
class StandRecord:
    """What is known of a stand. It never changes; what is learned later is a new version."""

    id: str
    version: int
    """Of the records of one stand identity, from 1."""
    identity: StandIdentity
    status: Status
    corrections: Corrections
    contributions: tuple[Contribution, ...]
    agreement_p: float | None
    """Chance of differences as large as those between the units; None for one unit."""
    validity: Validity
    created_at: datetime
    program_version: str
    content_sha256: str = ""
    """Of everything above in canonical spelling."""

    @property
    def units(self) -> tuple[str, ...]:
        """Serial numbers of the units that it rests on."""
        return tuple(contribution.serial_number for contribution in self.contributions)

    @property
    def applied(self) -> Message:
        """That it was applied to a run, in a sentence."""
        return Message(
            "corrected by stand record {version} of {stand}, learned from {units}",
            version=self.version,
            stand=self.identity.stand,
            units=series(self.units),
        )

    def source(self, columns_v: FloatArray) -> Source:
        """What is not known of the corrections, as many independent errors as they have coefficients.

        `columns_v` is what a unit of each adds to the rows, shape (rows, coefficients), in volts.
        """
        values, vectors = np.linalg.eigh(self.corrections.covariance)
        return Source(
            name=Message("stand record {version}", version=self.version),
            symbol=Message(
                "{coefficients} of {terms}, correlated",
                coefficients=Message.counted(
                    "{count} coefficient", "{count} coefficients", count=len(self.corrections.values)
                ),
                terms=Message.counted("{count} term", "{count} terms", count=len(self.corrections.terms)),
            ),
            errors_v=columns_v @ (vectors * np.sqrt(np.maximum(values, 0.0))),
        )

    @property
    def intact(self) -> bool:
        """Whether the record is what was recorded."""
        return canonical_sha256(content(self)) == self.content_sha256

    @property
    def reference(self) -> dict[str, Any]:
        """What a calibration says of the record that was applied to it."""
        return {"id": self.id, "version": self.version, "content_sha256": self.content_sha256}


def content(record: StandRecord) -> dict[str, Any]:
    """The record as JSON without its hash."""
    return plain(
        {
            "schema": f"tumble.stand-record/{FORMAT_VERSION}",
            "id": record.id,
            "version": record.version,
            "identity": asdict(record.identity),
            "status": str(record.status),
            "corrections": record.corrections.as_json(),
            "contributions": [asdict(contribution) for contribution in record.contributions],
            "agreement_p": record.agreement_p,
            "validity": asdict(record.validity),
            "created_at": utc_text(record.created_at),
            "program_version": record.program_version,
        }
    )


def document(record: StandRecord) -> dict[str, Any]:
    """The record as `tumble.stand-record/1`, with its hash and, where it has one, its head map."""
    head_map = record.corrections.head_map
    drawn = {} if head_map is None else {"head_map": head_map.as_json()}
    return content(record) | {"content_sha256": record.content_sha256} | drawn


def record_from_content(stored: Mapping[str, Any], content_sha256: str) -> StandRecord:
    """Undo `content`."""
    return StandRecord(
        id=stored["id"],
        version=stored["version"],
        identity=StandIdentity(**stored["identity"]),
        status=Status(stored["status"]),
        corrections=corrections_from_json(stored["corrections"]),
        contributions=tuple(Contribution(**_tuples(entry)) for entry in stored["contributions"]),
        agreement_p=stored["agreement_p"],
        validity=Validity(**_tuples(stored["validity"])),
        created_at=read_time(stored["created_at"]),
        program_version=stored["program_version"],
        content_sha256=content_sha256,
    )


def _tuples(entry: Mapping[str, Any]) -> dict[str, Any]:
    return {key: tuple(value) if isinstance(value, list) else value for key, value in entry.items()}
