"""`tumble resume`: go on with a run that was cut off."""

from functools import partial
from pathlib import Path

import click

from tumble.app.calibrating import conclude, make_ready
from tumble.app.commands import options
from tumble.app.commands.measuring import connected_for_a_run
from tumble.app.commands.telling import tell_calibrated, tell_recorded, tell_run
from tumble.app.console import messages, run_display
from tumble.app.recall import record_of
from tumble.app.resuming import Unfinished, find, lived_through, resume
from tumble.app.running import Job, failure
from tumble.app.same_stand import followed, load_same_stand
from tumble.app.stand_lock import holding, holding_recording
from tumble.app.terminal import language, say
from tumble.messages import Message
from tumble.procedures.errors import InputError


@click.command("resume")
@click.argument("recording", type=options.EXISTING)
@click.option("--stand", "stand_path", type=options.EXISTING, help="The stand file, where it was moved.")
@options.answers
@options.attended
@click.option(
    "--tolerance-v",
    type=click.FloatRange(min=0.0, min_open=True),
    callback=options.finite,
    help="By how much the last point may differ when it is taken again; without it, by what noise explains.",
)
@click.option("--store", "folder", type=options.EXISTING, help="Store of a calibration whose recording was moved.")
@options.json_out
@options.verbose
def command(
    recording: Path,
    stand_path: Path | None,
    answers: Path | None,
    attended: bool,
    tolerance_v: float | None,
    folder: Path | None,
    json_path: Path | None,
    verbose: bool,
) -> None:
    """Go on with a run that was cut off, and then with what was to follow it: fit, record and report.

    What is done already is not done again.
    """
    found = find(recording)
    with holding_recording(found.path, found.recording.header.serial_number):
        unfinished = find(recording)  # as it is now that nobody writes it any more
        _conclude(unfinished, stand_path, answers, attended, tolerance_v, folder, json_path, verbose)


def _conclude(
    unfinished: Unfinished,
    stand_path: Path | None,
    answers: Path | None,
    attended: bool,
    tolerance_v: float | None,
    folder: Path | None,
    json_path: Path | None,
    verbose: bool,
) -> None:
    """Do what is left of a run, and what was to follow it."""
    header = unfinished.recording.header
    store = _store(unfinished, folder) if header.job == "calibrate" else None
    points = len(unfinished.recording.points)
    if not unfinished.recording.complete:
        points = _go_on(unfinished, stand_path, answers, attended, tolerance_v, store)
    if store is None:
        tell_run(unfinished.path, points, json_path)
    elif record := record_of(unfinished.path, header, store):
        tell_recorded(unfinished.path, record, store, json_path)
    else:
        tell_calibrated(conclude(unfinished.path, store, language=language()), json_path, verbose=verbose)


def _go_on(
    unfinished: Unfinished,
    stand_path: Path | None,
    answers: Path | None,
    attended: bool,
    tolerance_v: float | None,
    store: Path | None,
) -> int:
    """Carry out what is left; return the number of points."""
    header = unfinished.recording.header
    loaded = load_same_stand(unfinished.recording, stand_path, partial(say, err=True))
    job = Job(
        stand=loaded,
        programme=unfinished.programme,
        serial_number=header.serial_number,
        lot=header.lot,
        operator=header.operator,
    )
    plan = job.plan()
    job.check(unfinished.recording.points)
    if store is not None:
        make_ready(store)
    with holding(loaded, header.serial_number):
        past = lived_through(followed(unfinished.recording), loaded, unfinished.recording)
        with connected_for_a_run(loaded, answers, attended, past) as connected:
            done = len(unfinished.recording.points)
            with run_display(plan, connected.stand.clock, messages(), done) as display:
                outcome = resume(unfinished, job, connected, [display], tolerance_v)
    if error := failure(outcome, unfinished.path):
        raise error
    return len(outcome.points)


def _store(unfinished: Unfinished, folder: Path | None) -> Path:
    """The store of a calibration, by where its recording lies: `STORE/recordings/SERIAL/RUN.mcap`."""
    if folder is not None:
        return folder
    parents = unfinished.path.resolve().parents
    if len(parents) < 3 or parents[1].name != "recordings":
        raise InputError(
            Message(
                "{path}: does not lie in a store; name the store of the calibration with --store", path=unfinished.path
            )
        )
    return parents[2]
