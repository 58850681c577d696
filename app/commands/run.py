"""`tumble run`: measure, and analyse later."""

from pathlib import Path

import click

from tumble.app.commands import options
from tumble.app.commands.measuring import measures
from tumble.app.commands.telling import tell_run
from tumble.app.console import messages, run_display
from tumble.app.files import check_recording_name
from tumble.app.recording_names import recording_path
from tumble.app.running import Job, failure, run
from tumble.app.wiring import Connected


@click.command("run")
@measures
@options.store
@click.option("--out", type=options.EXISTING, help="Recording to write; a new name in the store without.")
@options.json_out
def command(job: Job, connected: Connected, folder: Path, out: Path | None, json_path: Path | None) -> None:
    """Run a programme and leave a recording, to be fitted later."""
    clock = connected.stand.clock
    if out:
        check_recording_name(out)
    recording = out or recording_path(folder, job.serial_number, job.programme.name, clock)
    with run_display(job.plan(), clock, messages()) as display:
        outcome = run(job, connected, recording, [display])
    if error := failure(outcome, recording):
        raise error
    tell_run(recording, len(outcome.points), json_path)
