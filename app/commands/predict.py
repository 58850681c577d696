"""`tumble predict`: what a unit does under random vibration of a given spectrum."""

from pathlib import Path

import click

from tumble.app.commands import options
from tumble.app.console import warn
from tumble.app.methods import method_of, methods
from tumble.app.sections import show_sections
from tumble.calibrations.core.cells import TableError
from tumble.calibrations.core.reducing import Predicts
from tumble.calibrations.core.sentences import series
from tumble.messages import Message
from tumble.procedures.errors import InputError


@click.command("predict")
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=options.EXISTING)
@click.option(
    "--psd", "spectrum", required=True, help="Spectrum: a file (CSV: f_Hz, G_g2_Hz), or the name of a profile."
)
@click.option("--axis", type=click.Choice(["i", "o", "p"]), default="i", show_default=True, help="Axis of the unit.")
@options.verbose
@options.json_out
def command(files: tuple[Path, ...], spectrum: str, axis: str, verbose: bool, json_path: Path | None) -> None:
    """Predict the rectification of random vibration from tables of one unit (CSV), with its uncertainty."""
    method = method_of(files)
    if not isinstance(method, Predicts):
        able = series([each.title for each in methods() if isinstance(each, Predicts)], "or") or Message(
            "no method that is installed"
        )
        raise InputError(
            Message(
                "{path}: nothing is predicted of {title}; but of {able}", path=files[0], title=method.title, able=able
            )
        )
    try:
        found = method.predicted(files, spectrum, axis)
    except (TableError, ValueError) as error:
        raise InputError(str(error)) from error
    warn(found.warnings)
    if str(json_path) != "-":
        show_sections(found.sections(), verbose=verbose)
    options.write_json(found.document(), json_path)
