"""What the commands that measure have in common: a job, and a stand that is ready for it."""

from collections.abc import Callable
from datetime import UTC, datetime
from functools import wraps
from pathlib import Path

import click

from app.commands import options
from app.console import warn
from app.running import Job
from app.stand import load_stand
from app.stand_lock import holding
from app.wiring import connect
from procedures.errors import InputError
from procedures.programme import load_programme

_LONGEST_SERIAL = 100
_OPTIONS = (
    options.stand,
    click.option("--programme", default="seed", show_default=True, help="Name of a shipped programme, or a file."),
    click.option("--serial", "serial_number", required=True, help="Serial number of the unit."),
    click.option("--operator", default="", help="Who is at the stand; recorded."),
    options.answers,
    options.attended,
)


def measures(function: Callable[..., None]) -> Callable[..., None]:
    """Give a command the options of a job; it is called with the `Job`, the `Connected` stand and its own options."""

    @wraps(function)
    def command(  # one for every option
        stand_path: Path | None,
        programme: str,
        serial_number: str,
        operator: str,
        answers: Path | None,
        attended: bool,
        **own: object,
    ) -> None:
        if not serial_number.strip() or len(serial_number) > _LONGEST_SERIAL:
            raise InputError(f"--serial: give the unit's serial number, 1 to {_LONGEST_SERIAL} characters")
        loaded = load_stand(stand_path)
        warn(loaded.file.expired(datetime.now(tz=UTC).date()))
        job = Job(stand=loaded, programme=load_programme(programme), serial_number=serial_number, operator=operator)
        with holding(loaded, serial_number):
            connected = connect(loaded, answers, attended)
            try:
                warn(connected.warnings)
                function(job, connected, **own)
            finally:
                connected.links.close()

    for option in reversed(_OPTIONS):
        command = option(command)
    return command
