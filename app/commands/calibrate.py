"""`tumble calibrate`: the whole job."""

from pathlib import Path

import click

from app.calibrating import calibrate
from app.commands import options
from app.commands.measuring import measures
from app.console import messages, run_display, show_result, warn
from app.exits import Exit
from app.loop_console import show_loop
from app.running import Job
from app.wiring import Connected


@click.command("calibrate")
@measures
@options.store
@options.json_out
def command(job: Job, connected: Connected, folder: Path, json_path: Path | None) -> None:
    """Run a programme, fit the recording, trace what the model leaves, store the record and write the report."""
    console = messages()
    with run_display(job.plan(), connected.stand.clock, console) as display:
        done = calibrate(job, connected, folder, [display])
    warn(done.analysed.calibration.warnings)
    if str(json_path) != "-":
        show_result(done.analysed)
        show_loop(done.analysed.loop)
    console.print(f"recording {done.recording}\nrecord    {done.record.id}\nreport    {done.report}", soft_wrap=True)
    left = {"record": done.record.id, "recording": str(done.recording), "report": str(done.report)}
    options.write_json(done.analysed.as_json() | left, json_path)
    if not done.analysed.inside:
        raise SystemExit(int(Exit.OUTSIDE_LIMITS))
