"""`tumble records`: list, show, compare, export, verify."""

from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path

import click
from rich.table import Column, Table

from tumble.app.commands import options
from tumble.app.console import results
from tumble.app.exits import Exit
from tumble.app.recall import open_store, unprotected
from tumble.app.terminal import say
from tumble.app.verifying import Finding, leftovers, verified_record
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.quantities import format_concise
from tumble.calibrations.core.verdict import Model, Outcome
from tumble.calibrations.records.compare import compare
from tumble.calibrations.records.export import document
from tumble.calibrations.records.record import OLD_WORDS, Record


@click.group("records")
def command() -> None:
    """List, show, compare, export and verify stored calibrations."""


@command.command("list")
@click.option("--serial", "serial_number", help="Only this unit.")
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
        programme_name=programme,
        since=since.replace(tzinfo=UTC) if since else None,
        until=until.replace(tzinfo=UTC) if until else None,
        verdict=_outcome(verdict) if verdict else None,
    )
    if str(json_path) != "-":
        results().print(_listing(found))
    options.write_json({"schema": "tumble.records/1", "records": [document(record) for record in found]}, json_path)


def _outcome(word: str) -> Outcome:
    """The outcome that a word, new or old, stands for."""
    old = {spelling: outcome for outcome, spelling in OLD_WORDS.items()}
    return old.get(word) or Outcome(word)


def _listing(found: tuple[Record, ...]) -> Table:
    table = Table(Column("record", no_wrap=True), "unit", "programme", "measured", "revision", "verdict", "kx")
    for record in found:
        kx = record.values["kx"]
        value = "" if kx.value is None else format_concise(kx.value, kx.standard_uncertainty, kx.unit)
        origin = record.provenance
        measured = origin.measured_at or f"{record.created_at:%Y-%m-%d %H:%M}"
        table.add_row(
            record.id,
            origin.serial_number,
            origin.programme_name,
            measured,
            str(record.revision),
            record.verdict.outcome.words,
            "; ".join(filter(None, (value, kx.condition))),
        )
    return table


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
    say(f"unit       {origin.serial_number}", f"programme  {origin.programme_name} {origin.programme_sha256[:12]}")
    say(f"measured   {origin.measured_at}", f"raw file   {origin.raw_path} {origin.raw_sha256[:12]}")
    say(f"program    {origin.program_version} {origin.git_commit[:12]}{' (changed)' if origin.git_dirty else ''}")
    if old := unprotected(store.raw_file(record)):
        say(old)
    effects = [effect["name"] for effect in record.result.get("loop", {}).get("effects", [])]
    if effects:
        say(f"with {', '.join(effects)}")
    _show_parameters(record.values)
    if record.model is Model.AUGMENTED:
        say("of the declared model alone, which does not describe these data:")
        _show_parameters(record.parameters)


def _show_parameters(parameters: Mapping[str, Parameter]) -> None:
    for name, parameter in parameters.items():
        if parameter.value is None:
            say(f"  {name:7s}cannot be told: {parameter.reason}")
        else:
            value = format_concise(parameter.value, parameter.standard_uncertainty, parameter.unit)
            say(f"  {name:7s}{value}{parameter.condition and f'  {parameter.condition}'}")


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
    """Export a record as JSON (tumble.record/3)."""
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
    others = [_told(finding) for finding in (() if record_ids else leftovers(store))]
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
