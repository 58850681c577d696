"""`tumble effects`: adopt, list, show, retire effects of the laboratory's own."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

import click
from rich.table import Table

from tumble.app import reports
from tumble.app.adopted_effects import FOLDER, read_kept
from tumble.app.adopting import adopt
from tumble.app.adoption_wish import Wish, check_wish
from tumble.app.commands import options
from tumble.app.console import results
from tumble.app.files import write_new
from tumble.app.kept_with import kept_with
from tumble.app.named_runs import measured, units_of
from tumble.app.sections import show_sections
from tumble.app.stand import read_stand
from tumble.app.terminal import as_json, language, say
from tumble.calibrations.adopted.document import document
from tumble.calibrations.adopted.folder import RETIRED_SUFFIX, SUFFIX, Kept, Retired
from tumble.calibrations.adopted.sections import depends, sections, size_text, spread_text, status
from tumble.calibrations.records.times import utc_now
from tumble.calibrations.report.document import page_of_sections
from tumble.messages import Message
from tumble.procedures.errors import InputError

_HEADINGS: Final = (
    Message("effect"),
    Message("what"),
    Message("largest"),
    Message("kept with"),
    Message("units"),
    Message("spread"),
    Message("status"),
)


@click.group("effects")
def command() -> None:
    """Adopt what the loop leaves unexplained as an effect of the laboratory's own; list, show, retire such effects."""


@command.command("adopt")
@click.argument("sources", metavar="FILE|RECORD...", nargs=-1, required=True)
@click.option("--name", required=True, callback=options.name, help="Name of the effect, a word as in the catalogue.")
@click.option("--channel", default="", help="What it changes, of several: offset, scale, angle.")
@click.option("--variable", default="", help="What it follows, of several: time, temperature, 'acceleration ax'.")
@click.option("--unit-type", default="", callback=options.name, help="Keep it with this type of units.")
@click.option("--of-stand", is_flag=True, help="Keep it with the stand on which the runs were made.")
@click.option("--stand", "stand_path", type=options.EXISTING, help="Stand file, for tables.")
@options.operator
@options.store
@options.json_out
def adopt_command(
    sources: tuple[str, ...],
    stand_path: Path | None,
    folder: Path,
    json_path: Path | None,
    unit_type: str,
    of_stand: bool,
    **wanted: str,
) -> None:
    """Give a name to what recordings, tables, results (JSON) or records of --store leave unexplained.

    Files of one serial number are one unit. The effect is kept with the unit type of the programme that was run, unless
    told otherwise, and is sought on later runs of it. How its size differs from unit to unit is known from two on.
    """
    stand = read_stand(stand_path).recorded if stand_path else None
    measurements = [measured(source, stand, folder) for source in sources]
    where = kept_with(measurements, unit_type, of_stand=of_stand)
    wish = Wish(kept_with=where, **wanted)
    check_wish(wish, measurements[0].method, folder)
    effect, path = adopt(wish, units_of(measurements, folder), folder)
    kept = Kept(effect=effect, path=path, retired=None)
    if str(json_path) != "-":
        show_sections(sections(kept))
    say(Message("effect {path}", path=path), err=True)
    options.write_json(document(effect), json_path)


@command.command("list")
@options.store
@options.json_out
def list_command(folder: Path, json_path: Path | None) -> None:
    """List the effects of a store, those that were retired too."""
    found = read_kept(folder / FOLDER)
    if str(json_path) != "-":
        results().print(_listing(found))
    effects = [_document(each) for each in found]
    options.write_json({"schema": "tumble.adopted-effects/1", "effects": effects}, json_path)


def _listing(found: Sequence[Kept]) -> Table:
    table = Table(*_HEADINGS)
    for each in found:
        effect = each.effect
        row = (depends(effect), size_text(effect), effect.kept_with.words, str(len(effect.units)), spread_text(effect))
        table.add_row(effect.name, *row, status(each))
    return table


@command.command("show")
@click.argument("name")
@options.store
@options.json_out
@click.option("--report", "page", type=options.REPORT, help="Write a page (HTML) with the course as a figure here.")
def show(name: str, folder: Path, json_path: Path | None, page: Path | None) -> None:
    """Show an effect, by its name or by its file: its course, its units, what became of it."""
    kept = _kept(name, folder)
    shown = sections(kept)
    if str(json_path) != "-":
        show_sections(shown)
    options.write_json(_document(kept), json_path)
    if page is not None:
        reports.write(page_of_sections(Message("Adopted effect"), kept.effect.name, shown), page, language())


@command.command("retire")
@click.argument("name")
@click.option("--reason", required=True, help="Why it is sought no more.")
@options.operator
@options.store
def retire(name: str, reason: str, operator: str, folder: Path) -> None:
    """Seek an effect no more. Its file stays, with the reason beside it; no other effect gets its name."""
    kept = _kept(name, folder)
    if kept.retired is not None:
        raise InputError(
            Message("{name} was retired already: {reason}", name=kept.effect.name, reason=kept.retired.reason)
        )
    if not reason.strip():
        raise InputError(Message("--reason: say why {name} is sought no more", name=kept.effect.name))
    retired = Retired(
        name=kept.effect.name,
        effect_sha256=kept.effect.content_sha256,
        reason=reason,
        operator=operator,
        retired_at=utc_now(),
    )
    write_new(kept.path.with_name(kept.path.name.removesuffix(SUFFIX) + RETIRED_SUFFIX), as_json(retired.document()))
    say(Message("{name} is retired: {reason}", name=kept.effect.name, reason=reason))


def _kept(name: str, folder: Path) -> Kept:
    """An effect by its name in a store, or by its file. Raises `InputError`."""
    path = Path(name) if name.endswith(SUFFIX) else folder / FOLDER / f"{name}{SUFFIX}"
    found = read_kept(path) if path.is_file() else ()
    if not found:
        raise InputError(
            Message("{path}: there is no such effect; list what there is with tumble effects list", path=path)
        )
    return found[0]


def _document(kept: Kept) -> dict[str, Any]:
    retired = {"retired": kept.retired.document()} if kept.retired else {}
    return document(kept.effect) | retired
