"""`tumble control`: have a run under way pause, go on, take its last point again, or stop."""

from contextlib import suppress
from pathlib import Path
from typing import Final

import click

from tumble.app.commands import options
from tumble.app.control_file import SUFFIX, ControlFile, deaf
from tumble.app.files import check_recording_name
from tumble.app.terminal import say
from tumble.app.wishes import MOST_PAUSED_MIN, Wish
from tumble.messages import Message
from tumble.procedures.errors import InputError

PATIENCE_S: Final = 5.0
"""How long a run may take to hear, in real time."""


@click.command("control")
@click.argument("wish", type=click.Choice([wish.value for wish in Wish]))
@click.argument("recording", required=False, type=options.EXISTING)
@options.store
@click.option(
    "--at-most",
    "at_most_min",
    type=click.FloatRange(min=0.0, min_open=True),
    default=MOST_PAUSED_MIN,
    show_default=True,
    callback=options.finite,
    help="Minutes that a pause may last; after them the run is stopped, and can be resumed.",
)
def command(wish: str, recording: Path | None, folder: Path, at_most_min: float) -> None:
    """Have a run that was begun on the command line pause, continue, take its last point again, or stop.

    RECORDING is what the run writes; without it, it is the only run under way in --store. Everything stands while a run
    is paused, which may last until samples that are being taken are there.
    """
    file = _named(recording) if recording else _only_one(folder)
    line = f"{wish} {at_most_min:g}" if wish == Wish.PAUSE else wish
    try:
        heard = file.tell(line, PATIENCE_S)
    except FileNotFoundError as error:
        raise _nobody(file) from error
    except OSError as error:
        raise InputError(deaf(file, error)) from error
    if not heard:
        raise _nobody(file)
    say(Message("{path}: heard", path=file.path), err=True)


def _named(recording: Path) -> ControlFile:
    """Of the run that writes a recording. Raises `InputError`."""
    check_recording_name(recording)
    return ControlFile(recording)


def _only_one(folder: Path) -> ControlFile:
    """Of the only run under way in a store. Raises `InputError`."""
    files = [ControlFile(path) for path in sorted(folder.glob(f"recordings/*/*{SUFFIX}"))]
    if len(files) > 1:
        files = list(filter(_is_heard, files))
    if not files:
        raise InputError(
            Message("{folder}: no run is under way there; name its recording, or its --store", folder=folder)
        )
    if len(files) > 1:
        paths = ", ".join(str(file.path) for file in files)
        raise InputError(Message("several runs are under way ({paths}); name the recording of one", paths=paths))
    return files[0]


def _is_heard(file: ControlFile) -> bool:
    """Whether a run hears; the file of one that was killed is cleared away."""
    with suppress(OSError):
        if file.tell("", PATIENCE_S):
            return True
        file.close()
    return False


def _nobody(file: ControlFile) -> InputError:
    """No run hears; what was written to it is none of the next one."""
    file.close()
    return InputError(
        Message(
            "{path}: no run of the command line hears there; look at its terminal or window, and name its recording",
            path=file.path,
        )
    )
