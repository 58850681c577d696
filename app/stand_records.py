"""Stand records of a store: which one belongs to a measurement, and applying it."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tumble.app.jobs import find_job
from tumble.app.measurement import Measurement
from tumble.calibrations.records import DATABASE
from tumble.calibrations.stand_records.head_map import Curve
from tumble.calibrations.stand_records.record import StandIdentity, StandRecord, Status
from tumble.messages import Message
from tumble.procedures.errors import InputError

if TYPE_CHECKING:
    from tumble.calibrations.stand_records.store import StandRecords


def identity_of(measurement: Measurement) -> StandIdentity | None:
    """To which stand a measurement belongs, by its stand file and by what the instruments said; None without one."""
    return identity_of_stand(measurement.stand, measurement.serials)


def identity_of_stand(stand: Mapping[str, Any], serials: Mapping[str, str]) -> StandIdentity | None:
    """Which stand a stand file describes, with what its instruments said of their `serials`; None without one."""
    if not stand.get("name"):
        return None

    return StandIdentity(
        stand=str(stand["name"]),
        head=_instruments(stand, serials, "head", "positioners"),
        daq=_instruments(stand, serials, "daq", "samplers"),
    )


def _instruments(stand: Mapping[str, Any], serials: Mapping[str, str], one: str, several: str) -> str:
    """Driver and serial number; of a stand with several, those of each with its name."""
    if several not in stand:
        return _instrument(stand.get(one, {}), serials.get(one, ""))
    tables: Mapping[str, Mapping[str, Any]] = stand[several]
    return ", ".join(
        f"{name} {_instrument(table, serials.get(name, ''))}".strip() for name, table in sorted(tables.items())
    )


def _instrument(table: Mapping[str, Any], serial: str) -> str:
    return f"{table.get('driver', '')} {table.get('serial') or serial}".strip()


def with_stand_record(measurement: Measurement, folder: Path | None) -> Measurement:
    """A measurement corrected by the stand record in force, where its stand file wants that.

    Without such a record it stays as it is and a warning says why: what is measured is not lost, and the first runs on
    a stand are those from which its record is learned.

    Parameters
    ----------
    measurement
        The raw file.
    folder
        Store of the stand records; None where there is none.

    Raises
    ------
    InputError
        The stand file in it does not fit.
    StoreError
        The store cannot be read.
    """
    part = find_job(measurement.method).stand
    if part is None or not measurement.uses_stand_record or not part.correctable(measurement.observations):
        return measurement
    identity = identity_of(measurement)
    records = _stand_records(folder) if folder is not None and (folder / DATABASE).is_file() else None
    record = records.in_force(identity) if records and identity else None
    if record is None:
        sentence = Message(
            "{path}: {why_not}; the run is not corrected",
            path=measurement.path,
            why_not=_why_not(records, identity, folder),
        )
        return _warned(measurement, sentence)
    return corrected_by(record, measurement)


def corrected_by(record: StandRecord, measurement: Measurement) -> Measurement:
    """A measurement corrected by one stand record; what lies beyond its ranges is warned of."""
    part = find_job(measurement.method).stand
    assert part is not None, "whoever learns of a stand corrects by it"
    rows = measurement.observations
    done = replace(measurement, observations=part.corrected(rows, record), stand_record=record)
    beyond = record.validity.exceeded_by(part.validity(rows))
    if not beyond:
        return done
    return _warned(
        done,
        Message(
            "{path}: beyond what stand record {version} knows: {effects}",
            path=measurement.path,
            version=record.version,
            effects=", ".join(beyond),
        ),
    )


def _why_not(records: "StandRecords | None", identity: StandIdentity | None, folder: Path | None) -> str:
    if records is None or identity is None:
        where = (
            Message("{folder} holds none", folder=folder)
            if folder is not None
            else Message("no store was named (--store)")
        )
        return Message("its stand file wants the stand record, but {where}", where=where)
    others = [record for record in records.find(stand=identity.stand) if record.status is Status.IN_FORCE]
    if others:
        last = others[-1]
        return Message(
            "stand record {version} of {stand} is for head {head} and DAQ {daq}, the run was made with head "
            "{head2} and DAQ {daq2}: it does not apply",
            version=last.version,
            stand=identity.stand,
            head=last.identity.head,
            daq=last.identity.daq,
            head2=identity.head,
            daq2=identity.daq,
        )
    return Message(
        "no stand record of {stand} is in force: two units must agree on one (tumble stand learn)", stand=identity.stand
    )


def _stand_records(folder: Path) -> "StandRecords":
    from tumble.calibrations.stand_records.store import StandRecords  # takes half a second, for those that have some

    return StandRecords(folder)


def _warned(measurement: Measurement, sentence: str) -> Measurement:
    rows = measurement.observations
    return replace(measurement, observations=replace(rows, warnings=(*rows.warnings, sentence)))


def list_stand_records(folder: Path, stand: str | None = None) -> tuple[StandRecord, ...]:
    """Stand records of a store, each stand's in the order of their versions. Raises `InputError`, `StoreError`."""
    if not (folder / DATABASE).is_file():
        raise InputError(
            Message(
                "{folder}: there is no {database} in this folder; name the folder of a store",
                folder=folder,
                database=DATABASE,
            )
        )
    return _stand_records(folder).find(stand=stand)


def head_map_curve(record: StandRecord, direction: int = 1, step_deg: float = 1.0) -> Curve | None:
    """The head map of a record as arrays for a plot, see `HeadMap.curve`; None where it has none."""
    head_map = record.corrections.head_map
    return head_map.curve(direction, step_deg) if head_map else None
