"""Options that several commands share."""

import math
import os
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial, wraps
from pathlib import Path
from typing import Any

import click

from tumble.app.files import check_result, write_text
from tumble.app.kinds import Kind, report_kind
from tumble.app.names import given_name
from tumble.app.terminal import as_json, say_document
from tumble.messages import Message


class Output(click.Path):
    """A file to be written: refused before anything is done for it where it may not be. See `tumble.app.files`."""

    def __init__(self, kind: Callable[[Path], Kind]) -> None:
        super().__init__(path_type=Path)
        self._kind = kind

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:  # noqa: ANN401
        """Check the place; `-` is standard output. Raises `InputError`, `JobError`."""
        path = Path(os.fsdecode(super().convert(value, param, ctx)))
        if str(path) == "-":
            return path
        check_result(path, self._kind(path))
        others = ctx.meta.setdefault(__name__, {}) if ctx else {}
        if others.setdefault(path.resolve(), param) is not param:
            self.fail(Message("{path} is wanted for another result of this command too.", path=path), param, ctx)
        return path


def _always(kind: Kind, _path: Path) -> Kind:
    return kind


EXISTING = click.Path(path_type=Path)
RESULT, RECORD, TABLE = (Output(partial(_always, kind)) for kind in (Kind.RESULT, Kind.RECORD, Kind.TABLE))
REPORT = Output(report_kind)
STORE = Path("tumble-store")

stand = click.option("--stand", "stand_path", type=EXISTING, help="Stand file; the built-in simulated stand without.")
store = click.option(
    "--store", "folder", type=EXISTING, default=STORE, show_default=True, help="Folder of the records."
)
json_out = click.option("--json", "json_path", type=RESULT, help="Write the result as JSON; - for standard output.")
effects = click.option(
    "--effects",
    type=EXISTING,
    help="File or folder of adopted effects that are sought, in place of those in the store.",
)


@dataclass(frozen=True, kw_only=True)
class Known:
    """Where that lies which is known before a run."""

    folder: Path
    """The store."""
    effects: Path | None
    """Adopted effects in place of those of the store."""


def known(function: Callable[..., None]) -> Callable[..., None]:
    """Give a command `--store` and `--effects`; it is called with both as `known`."""

    @wraps(function)
    def command(*arguments: object, folder: Path, effects: Path | None, **own: object) -> None:
        function(*arguments, known=Known(folder=folder, effects=effects), **own)

    return store(effects(command))


def name(_context: click.Context, parameter: click.Parameter, value: str) -> str:
    """A name without the blanks round it. Raises `InputError` where it can be none."""
    return given_name(value, parameter.opts[0])


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
lot = click.option("--lot", default="", callback=name, help="Lot in which the unit was made; recorded.")
lot_of_file = click.option(
    "--lot", default="", callback=name, help="Lot of the unit, where the file does not say, or says another."
)
operator = click.option("--operator", default="", callback=name, help="Who is at the stand; recorded.")
answers = click.option("--answers", type=EXISTING, help="Answers to prompts, for a run that nobody attends (TOML).")
attended = click.option(
    "--attended", is_flag=True, help="Ask for mounts on the terminal; a simulated stand then runs in real time."
)


verbose = click.option("--verbose", "-v", is_flag=True, help="Say more than the answer: rows, noise, significance.")


def finite(_context: click.Context, _parameter: click.Parameter, value: float | None) -> float | None:
    """Refuse what is no number and what has no end, which no range of click does."""
    if value is not None and not math.isfinite(value):
        raise click.BadParameter(Message("{value} is no finite number.", value=value))
    return value


def write_json(document: dict[str, Any], path: Path | None) -> None:
    """Write a document where `--json` says; nowhere without it. Raises `JobError`."""
    if path is None:
        return
    known = {"schema": document["schema"], **document}  # in front, where `tumble.app.kinds` looks for it
    if str(path) == "-":
        say_document(known)
    else:
        write_text(path, as_json(known))
