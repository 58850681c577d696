"""`tumble stand`: list, show, learn, verify what is known of stands."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Final

import click
import numpy as np
from rich.table import Table

from tumble.app.analysing import fit, trace
from tumble.app.commands import options
from tumble.app.console import results
from tumble.app.exits import Exit
from tumble.app.learning import learn
from tumble.app.measurements import read_measurement
from tumble.app.rederiving import Rederivation
from tumble.app.referencing import is_reference, learn_from_reference
from tumble.app.stand import read_stand
from tumble.app.stand_records import list_stand_records
from tumble.app.terminal import labelled, numeric, say
from tumble.calibrations.core.quantities import format_number
from tumble.calibrations.core.sentences import equals, series
from tumble.calibrations.records.verify import TOLERANCE
from tumble.calibrations.stand_records.corrections import Corrections
from tumble.calibrations.stand_records.head_map import HeadMap
from tumble.calibrations.stand_records.record import StandRecord, document
from tumble.messages import Message
from tumble.procedures.errors import InputError

_ARCSEC = 3600.0
_HEADINGS: Final = (
    Message("stand"),
    Message("version"),
    Message("head"),
    Message("DAQ"),
    Message("status"),
    Message("units"),
    Message("what"),
    Message("made"),
)


@click.group("stand")
def command() -> None:
    """List, show, learn and verify what is known of stands: head map, axis tilt, errors of the voltmeter."""


@command.command("list")
@options.store
@options.json_out
def list_command(folder: Path, json_path: Path | None) -> None:
    """List the stand records of a store, each stand's in the order of their versions."""
    found = list_stand_records(folder)
    if str(json_path) != "-":
        results().print(_listing(found))
    options.write_json({"schema": "tumble.stand-records/1", "records": [document(r) for r in found]}, json_path)


def _listing(found: tuple[StandRecord, ...]) -> Table | str:
    if not found:
        return Message("No stand record yet; tumble stand learn makes one.")
    table = Table(*_HEADINGS)
    for record in found:
        what = series(list(dict.fromkeys(term.effect for term in record.corrections.terms)))
        key = record.identity
        made, units = f"{record.created_at:%Y-%m-%d %H:%M}", series(record.units)
        table.add_row(key.stand, str(record.version), key.head, key.daq, record.status, units, what, made)
    return table


@command.command("show")
@click.argument("name")
@click.option("--version", type=click.IntRange(min=1), help="Which version; the newest one without.")
@options.store
@options.json_out
def show(name: str, version: int | None, folder: Path, json_path: Path | None) -> None:
    """Show what is known of a stand, by the name in its stand file; of several heads, the one known last."""
    found = [record for record in list_stand_records(folder, name) if version in (None, record.version)]
    if not found:
        which = Message("no stand record {version}", version=version) if version else Message("no stand record")
        raise InputError(
            Message(
                "{folder}: there is {which} of {name}; list them with tumble stand list",
                folder=folder,
                which=which,
                name=name,
            )
        )
    record = max(found, key=lambda each: each.created_at)
    if str(json_path) != "-":
        say(*_lines(record))
    options.write_json(document(record), json_path)


def _lines(record: StandRecord) -> Iterator[str]:
    fields = {"record_id": record.id, "version": record.version, "status": record.status.words}
    told = Message("{record_id}, version {version}, {status}", **fields)
    if record.agreement_p is not None:
        agreement = equals(record.agreement_p)
        told = Message("{record}, the units agree (p {probability})", record=told, probability=agreement)
    key = record.identity
    yield labelled(Message("record"), told)
    yield labelled(
        Message("stand"), Message("{stand}, head {head}, DAQ {daq}", stand=key.stand, head=key.head, daq=key.daq)
    )
    for unit in record.contributions:
        for path, sha256 in zip(unit.raw_paths, unit.raw_sha256, strict=True):
            yield labelled(Message("unit"), f"{unit.serial_number}  {path}  {sha256[:12]}")
    for term in record.corrections.terms:
        yield Message("  {correction}", correction=record.corrections.text(term))
    if head_map := record.corrections.head_map:
        yield from _map_lines(head_map)


def _map_lines(head_map: HeadMap) -> Iterator[str]:
    """The map every 30 degrees, in seconds of arc."""
    angle_deg = np.arange(0.0, 360.0, 30.0)
    error, uncertainty = head_map.error_deg(angle_deg), head_map.standard_uncertainty_deg(angle_deg)
    rows = zip(angle_deg, error * _ARCSEC, uncertainty * _ARCSEC, strict=True)
    errors = Message(
        "true - reported, {rms_arcsec}″ r.m.s., after moves in + direction",
        rms_arcsec=format_number(head_map.rms_deg * _ARCSEC),
    )
    yield labelled(Message("head map"), errors)
    for angle, value, u in rows:
        yield numeric(f"  {angle:5.0f}°  {value:8.2f}″ ± {u:.2f}″")


@command.command("learn")
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=options.EXISTING)
@click.option("--stand", "stand_path", type=options.EXISTING, help="Stand file, for tables.")
@options.serial_of_file
@options.store
def learn_command(files: tuple[Path, ...], stand_path: Path | None, serial_number: str, folder: Path) -> None:
    """Hold recordings or tables, each of one unit, one after the other against what is known of their stand.

    A first unit gives a provisional record. Once a second one agrees, both give a record in force. A table of the head
    against a reference gives one at once.
    """
    stand = read_stand(stand_path).recorded if stand_path else None
    for file in files:
        if is_reference(file):
            record = learn_from_reference(file, _known(stand or {}, file), folder)
            name, version = record.identity.stand, record.version
            say(
                Message(
                    "stand {name}: the reference gives a head map: stand record {version} is in force",
                    name=name,
                    version=version,
                )
            )
            continue
        measurement = read_measurement(file, stand)
        _known(measurement.stand, file)
        traced = trace(fit(measurement, serial_number, trials=0, folder=folder))
        learned = learn(traced, folder)
        say(
            *learned.sentences
            or (Message("{path}: nothing of its stand is to be learned that is not known", path=file),)
        )


def _known(stand: Mapping[str, Any], file: Path) -> Mapping[str, Any]:
    """The stand file as data. Raises `InputError` where there is none."""
    if not stand:
        raise InputError(
            Message("{path}: does not say on which stand it was measured; give the stand file with --stand", path=file)
        )
    return stand


@command.command("verify")
@click.argument("names", nargs=-1)
@options.store
def verify(names: tuple[str, ...], folder: Path) -> None:
    """Verify stand records, of these stands or of all: hash record and raw files, derive them again, compare."""
    records = [record for record in list_stand_records(folder) if not names or record.identity.stand in names]
    if unknown := sorted(set(names) - {record.identity.stand for record in records}):
        raise InputError(
            Message(
                "{folder}: there is no stand record of {names}; list them with tumble stand list",
                folder=folder,
                names=series(unknown, "or"),
            )
        )
    again, failed = Rederivation(folder), 0
    for record in records:
        problem = _problem(record, again)
        failed += bool(problem)
        words = Message("NOT VERIFIED: {problem}", problem=problem) if problem else Message("verified")
        say(
            Message(
                "{stand} {version} ({record_id}): {words}",
                stand=record.identity.stand,
                version=record.version,
                record_id=record.id,
                words=words,
            )
        )
    say(
        Message.counted(
            "{verified} of {count} stand record comes back from its raw files",
            "{verified} of {count} stand records come back from their raw files",
            verified=len(records) - failed,
            count=len(records),
        )
    )
    if failed:
        raise SystemExit(int(Exit.BAD_INPUT))


def _problem(record: StandRecord, rederivation: Rederivation) -> str:
    """What keeps a record from being believed; empty where nothing does."""
    if not record.intact:
        return Message("it was altered in the store")
    again = rederivation.corrections(record)
    if again is None:
        return Message("a raw file is missing or changed")
    return "" if _alike(record.corrections, again) else Message("derived again, it does not come back")


def _alike(recorded: Corrections, again: Corrections) -> bool:
    """Every coefficient and its uncertainty to within `TOLERANCE` of the uncertainty."""
    if again.terms != recorded.terms:
        return False
    u, u_again = (np.sqrt(np.diag(each.covariance)) for each in (recorded, again))
    off = np.maximum(np.abs(again.values - recorded.values), np.abs(u_again - u))
    return bool(np.all(off <= TOLERANCE * u))
