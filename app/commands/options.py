"""Options that several commands share."""

import json
import math
from pathlib import Path
from typing import Any

import click

from app.files import write_text

EXISTING = click.Path(path_type=Path)
STORE = Path("tumble-store")

stand = click.option("--stand", "stand_path", type=EXISTING, help="Stand file; the built-in simulated stand without.")
store = click.option(
    "--store", "folder", type=EXISTING, default=STORE, show_default=True, help="Folder of the records."
)
stand_store = click.option("--store", "folder", type=EXISTING, help="Folder that holds the stand record to be applied.")
json_out = click.option("--json", "json_path", type=EXISTING, help="Write the result as JSON; - for standard output.")

serial = click.option("--serial", "serial_number", default="", help="Serial number of the unit.")
serial_needed = click.option("--serial", "serial_number", required=True, help="Serial number of the unit.")
operator = click.option("--operator", default="", help="Who is at the stand; recorded.")
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
    text = json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False) + "\n"
    if str(path) == "-":
        click.echo(text, nl=False)
    else:
        write_text(path, text)
