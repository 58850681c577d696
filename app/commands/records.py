"""`tumble records`: list, show, compare, export, verify, migrate."""

from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path

import click

from tumble.app.commands import options
from tumble.app.console import results
from tumble.app.exits import Exit
from tumble.app.opening import open_store
from tumble.app.recall import unprotected
from tumble.app.record_console import listing, show_parameters
from tumble.app.terminal import labelled, say
from tumble.app.verifying import Finding, Judgement, leftovers, verified_record
from tumble.calibrations.core.verdict import Model, Outcome
from tumble.calibrations.records.compare import compare
from tumble.calibrations.records.export import document
from tumble.calibrations.records.findings import names_found, words_of
from tumble.calibrations.records.old_formats import OLD_WORDS, outcome_of
from tumble.calibrations.records.record import Record
from tumble.calibrations.records.unlike import unlike
from tumble.messages import AsWritten, Message


@click.group("records")
def command() -> None:
    """List, show, compare, export, verify and migrate stored calibrations."""


@command.command("list")
@click.option("--serial", "serial_number", help="Only this unit.")
@click.option("--lot", help="Only units of this lot.")
@click.option("--method", help="Only this method.")
@click.option("--programme", "programme_name", help="Only this programme.")
@click.option(
    "--effect",
    "finding",
    help="Only where this effect was found; if empty, where none was.",
)
@click.option("--since", type=click.DateTime(), help="Measured then or later (UTC).")
@click.option("--until", type=click.DateTime(), help="Measured then or earlier (UTC).")
@click.option(
    "--verdict",
    type=click.Choice([*map(str, Outcome), *OLD_WORDS.values()]),
    help="Only with this verdict; the older words mean pass, fail and no_limits.",
)
@options.store
@options.json_out
def list_records(
    since: datetime | None,
    until: datetime | None,
    verdict: str | None,
    folder: Path,
    json_path: Path | None,
    **only: str | None,
) -> None:
    """List the records that stand, each in its last revision."""
    found = open_store(folder).find(
        **only,
        since=since.replace(tzinfo=UTC) if since else None,
        until=until.replace(tzinfo=UTC) if until else None,
        verdict=outcome_of(verdict) if verdict else None,
    )
    if str(json_path) != "-":
        results().print(listing(found))
    options.write_json({"schema": "tumble.records/1", "records": [document(record) for record in found]}, json_path)


@command.command("show")
@click.argument("record_id")
@options.store
def show(record_id: str, folder: Path) -> None:
    """Show a record, by the beginning of its id."""
    store = open_store(folder)
    record = store.get(record_id)
    revision = Message(
        "{record_id}, revision {revision}, {outcome}",
        record_id=record.id,
        revision=record.revision,
        outcome=record.verdict.outcome.words,
    )
    say(labelled(Message("record"), revision))
    for judgement in record.verdict.parameters:
        say(Message("  {sentence}", sentence=judgement.sentence))
    if record.supersedes:
        say(labelled(Message("supersedes"), record.supersedes))
    say(*_origin(record))
    if old := unprotected(store.raw_files(record)):
        say(old)
    if found := names_found(record):
        say(Message("with {effects}", effects=Message.joined(", ", map(words_of, found))))
    show_parameters(record.values)
    if record.model is Model.AUGMENTED:
        say(Message("of the declared model alone, which does not describe these data:"))
        show_parameters(record.parameters)


def _origin(record: Record) -> Iterator[str]:
    """Where a record comes from, a line for each thing."""
    origin = record.provenance
    version = Message("{method}, version {version}", method=record.method, version=record.method_version)
    yield labelled(Message("method"), version)
    yield labelled(Message("unit"), AsWritten(origin.serial_number))
    if origin.lot:
        yield labelled(Message("lot"), AsWritten(origin.lot))
    yield labelled(Message("programme"), f"{origin.programme_name} {origin.programme_sha256[:12]}")
    yield labelled(Message("measured"), origin.measured_at)
    for source in origin.sources:
        yield labelled(Message("raw file"), f"{source.path} {source.sha256[:12]}")
    program = f"{origin.program_version} {origin.git_commit[:12]}"
    yield labelled(Message("program"), Message("{program} (changed)", program=program) if origin.git_dirty else program)


@command.command("compare")
@click.argument("first")
@click.argument("second")
@options.store
def compare_records(first: str, second: str, folder: Path) -> None:
    """Compare two records: the difference of every parameter and whether it is significant (5% for all together)."""
    store = open_store(folder)
    before, after = store.get(first), store.get(second)
    differences = compare(before, after)
    for label, record in ((Message("first"), before), (Message("second"), after)):
        say(labelled(label, _called(record)))
    for line in (*unlike(before, after), *(each.sentence for each in differences)):
        say(line)


def _called(record: Record) -> Message:
    """A record by its unit, when it was measured, and its id."""
    origin = record.provenance
    return Message(
        "{unit}, {measured}, record {id}",
        unit=AsWritten(origin.serial_number),
        measured=origin.measured_at,
        id=AsWritten(record.id),
    )


@command.command("export")
@click.argument("record_id")
@options.store
@click.option("--json", "json_path", type=options.RECORD, default=Path("-"), help="File; standard output without.")
def export(record_id: str, folder: Path, json_path: Path) -> None:
    """Export a record as JSON (tumble.record/5; older records in their own format)."""
    options.write_json(document(open_store(folder).get(record_id)), json_path)


@command.command("verify")
@click.argument("record_ids", nargs=-1)
@options.store
def verify(record_ids: tuple[str, ...], folder: Path) -> None:
    """Verify records, or all that stand: hash the raw files again, fit again, say whether the numbers come back.

    Without an id, what in the folder belongs to no record is named too.
    """
    store = open_store(folder)
    ids = [store.resolve(record_id) for record_id in record_ids] or store.standing()
    records = [_told(verified_record(store, record_id)) for record_id in ids]
    told = [(finding, _told(finding)) for finding in (() if record_ids else leftovers(store))]
    others = [good for finding, good in told if finding.judgement is not Judgement.WHOLE]
    agreeing = Message.counted(
        "{agreeing} of {count} record agrees with its raw files",
        "{agreeing} of {count} records agree with their raw files",
        agreeing=sum(records),
        count=len(records),
    )
    say(Message.joined("; ", filter(None, [agreeing, _more(others)])))
    if not all([*records, *others]):
        raise SystemExit(int(Exit.BAD_INPUT))


def _told(finding: Finding) -> bool:
    """Print a finding; return whether it is a good one."""
    say(Message("{name}: {judgement}", name=finding.name, judgement=finding.judgement.words))
    for sentence in finding.sentences:
        say(Message("  {sentence}", sentence=sentence))
    return finding.good


def _more(others: list[bool]) -> str:
    if not others:
        return ""
    return Message.counted(
        "{count} more finding, {wrong} of them wrong",
        "{count} more findings, {wrong} of them wrong",
        count=len(others),
        wrong=others.count(False),
    )


@command.command("migrate")
@options.store
def migrate(folder: Path) -> None:
    """Bring a store that an older version made to the tables of this version; a copy of the old database is kept.

    The first record added does the same. To be read, an older store need not be migrated.
    """
    store = open_store(folder)
    copy = store.migrate()
    say(
        Message("{path} is of this version: nothing was done", path=store.path)
        if copy is None
        else Message("{path}: migrated", path=store.path)
    )
    if copy:
        say(Message("the database as it was is kept in {copy}", copy=copy))
