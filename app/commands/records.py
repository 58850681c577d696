"""`tumble records`: list, show, compare, export, verify, migrate."""

from datetime import UTC, datetime
from pathlib import Path

import click

from tumble.app.commands import options
from tumble.app.console import results
from tumble.app.exits import Exit
from tumble.app.recall import open_store, unprotected
from tumble.app.record_console import effects_of, listing, show_parameters
from tumble.app.terminal import say
from tumble.app.verifying import Finding, Judgement, leftovers, verified_record
from tumble.calibrations.core.verdict import Model, Outcome
from tumble.calibrations.records.compare import compare
from tumble.calibrations.records.export import document
from tumble.calibrations.records.old_formats import OLD_WORDS, outcome_of


@click.group("records")
def command() -> None:
    """List, show, compare, export, verify and migrate stored calibrations."""


@command.command("list")
@click.option("--serial", "serial_number", help="Only this unit.")
@click.option("--method", help="Only this method.")
@click.option("--programme", help="Only this programme.")
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
    serial_number: str | None,
    method: str | None,
    programme: str | None,
    since: datetime | None,
    until: datetime | None,
    verdict: str | None,
    folder: Path,
    json_path: Path | None,
) -> None:
    """List the records that stand, each in its last revision."""
    found = open_store(folder).find(
        serial_number=serial_number,
        method=method,
        programme_name=programme,
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
    origin = record.provenance
    say(f"record     {record.id}, revision {record.revision}, {record.verdict.outcome.words}")
    for judgement in record.verdict.parameters:
        say(f"  {judgement.sentence}")
    if record.supersedes:
        say(f"supersedes {record.supersedes}")
    say(f"method     {record.method}, version {record.method_version}")
    say(f"unit       {origin.serial_number}", f"programme  {origin.programme_name} {origin.programme_sha256[:12]}")
    say(f"measured   {origin.measured_at}")
    for source in origin.sources:
        say(f"raw file   {source.path} {source.sha256[:12]}")
    say(f"program    {origin.program_version} {origin.git_commit[:12]}{' (changed)' if origin.git_dirty else ''}")
    if old := unprotected(store.raw_files(record)):
        say(old)
    if effects := [effect["name"] for effect in effects_of(record)]:
        say(f"with {', '.join(effects)}")
    show_parameters(record.values)
    if record.model is Model.AUGMENTED:
        say("of the declared model alone, which does not describe these data:")
        show_parameters(record.parameters)


@command.command("compare")
@click.argument("first")
@click.argument("second")
@options.store
def compare_records(first: str, second: str, folder: Path) -> None:
    """Compare two records: the difference of every parameter and whether it is significant."""
    store = open_store(folder)
    for difference in compare(store.get(first), store.get(second)):
        say(difference.sentence)


@command.command("export")
@click.argument("record_id")
@options.store
@click.option("--json", "json_path", type=options.RECORD, default=Path("-"), help="File; standard output without.")
def export(record_id: str, folder: Path, json_path: Path) -> None:
    """Export a record as JSON (tumble.record/4; older records in their own format)."""
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
    say(f"{sum(records)} of {len(records)} records agree with their raw files{_more(others)}")
    if not all([*records, *others]):
        raise SystemExit(int(Exit.BAD_INPUT))


def _told(finding: Finding) -> bool:
    """Print a finding; return whether it is a good one."""
    say(f"{finding.name}: {finding.judgement}")
    for sentence in finding.sentences:
        say(f"  {sentence}")
    return finding.good


def _more(others: list[bool]) -> str:
    if not others:
        return ""
    return f"; {len(others)} more finding{'s' if len(others) > 1 else ''}, {others.count(False)} of them wrong"


@command.command("migrate")
@options.store
def migrate(folder: Path) -> None:
    """Bring a store that an older version made to the tables of this version; a copy of the old database is kept.

    The first record added does the same. To be read, an older store need not be migrated.
    """
    store = open_store(folder)
    copy = store.migrate()
    say(f"{store.path} is of this version: nothing was done" if copy is None else f"{store.path}: migrated")
    if copy:
        say(f"the database as it was is kept in {copy}")
