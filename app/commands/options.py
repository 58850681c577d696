"""Options that several commands share."""

import math
from pathlib import Path
from typing import Any

import click

from app.files import write_text
from app.terminal import as_json, say_document
from drivers.text import check_name
from procedures.errors import InputError

EXISTING = click.Path(path_type=Path)
STORE = Path("tumble-store")

stand = click.option("--stand", "stand_path", type=EXISTING, help="Stand file; the built-in simulated stand without.")
store = click.option(
    "--store", "folder", type=EXISTING, default=STORE, show_default=True, help="Folder of the records."
)
stand_store = click.option("--store", "folder", type=EXISTING, help="Folder that holds the stand record to be applied.")
json_out = click.option("--json", "json_path", type=EXISTING, help="Write the result as JSON; - for standard output.")


def name(_context: click.Context, parameter: click.Parameter, value: str) -> str:
    """Refuse what cannot serve as a name. Raises `InputError`."""
    try:
        return check_name(value)
    except ValueError as error:
        raise InputError(f"{parameter.opts[0]}: {error}") from error


serial = click.option("--serial", "serial_number", default="", callback=name, help="Serial number of the unit.")
serial_needed = click.option(
    "--serial", "serial_number", required=True, callback=name, help="Serial number of the unit."
)
serial_of_file = click.option(
    "--serial",
    "serial_number",
    default="",
    callback=name,
    help="Serial number of the unit, where the file does not say.",
)
operator = click.option("--operator", default="", callback=name, help="Who is at the stand; recorded.")
answers = click.option("--answers", type=EXISTING, help="Answers to prompts, for a run that nobody attends (TOML).")
attended = click.option(
    "--attended", is_flag=True, help="Ask for mounts on the terminal; a simulated stand then runs in real time."
)


def finite(_context: click.Context, _parameter: click.Parameter, value: float | None) -> float | None:
    """Refuse what is no number and what has no end, which no range of click does."""
    if value is not None and not math.isfinite(value):
        raise click.BadParameter(f"{value} is no finite number.")
    return value


def write_json(document: dict[str, Any], path: Path | None) -> None:
    """Write a document where `--json` says; nowhere without it. Raises `JobError`."""
    if path is None:
        return
    if str(path) == "-":
        say_document(document)
    else:
        write_text(path, as_json(document))
