"""`tumble gui`: the operator's window. Qt is imported when it is opened."""

import gc
from pathlib import Path

import click

from tumble.app.commands import options
from tumble.app.exits import Exit, JobError


@click.command("gui")
@options.store
def command(folder: Path) -> None:
    """Open the operator's window."""
    from tumble.window.libraries import obstacle

    if sentence := obstacle():
        raise JobError(sentence, Exit.BAD_INPUT)
    gc.disable()  # nothing of what is loaded now is ever garbage, and the window collects its own
    from tumble.window.start import show

    raise SystemExit(show(folder.absolute()))
