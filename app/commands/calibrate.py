"""`tumble calibrate`: the whole job."""

from pathlib import Path

import click

from tumble.app.calibrating import calibrate
from tumble.app.commands import options
from tumble.app.commands.measuring import measures
from tumble.app.commands.telling import tell_calibrated
from tumble.app.console import messages, run_display
from tumble.app.running import Job
from tumble.app.terminal import language
from tumble.app.wiring import Connected


@click.command("calibrate")
@measures
@options.known
@options.json_out
@options.verbose
def command(job: Job, connected: Connected, known: options.Known, json_path: Path | None, verbose: bool) -> None:
    """Run a programme, fit the recording, trace what the model leaves, store the record and write the report."""
    with run_display(job.plan(), connected.stand.clock, messages()) as display:
        done = calibrate(job, connected, known.folder, [display], language=language(), effects=known.effects)
    tell_calibrated(done, json_path, verbose=verbose)
