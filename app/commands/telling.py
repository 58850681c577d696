"""What a command says at its end, on the terminal and as JSON."""

from pathlib import Path

from tumble.app.adopted_effects import adopted_json
from tumble.app.calibrating import Calibrated, has_report
from tumble.app.commands.leaving import leave_by
from tumble.app.commands.options import write_json
from tumble.app.console import show_result, show_verdict, warn
from tumble.app.kept_reports import report_path
from tumble.app.reporting import report_again
from tumble.app.sections import show_sections
from tumble.app.terminal import labelled, language, say
from tumble.calibrations.records.record import Record
from tumble.messages import Message


def tell_run(recording: Path, points: int, json_path: Path | None) -> None:
    """Say that a run has left a recording."""
    say(Message("recording {recording}", recording=recording), err=True)
    write_json({"schema": "tumble.run/1", "recording": str(recording), "points": points}, json_path)


def tell_calibrated(done: Calibrated, json_path: Path | None, *, verbose: bool = False) -> None:
    """Show what a calibration gave. Raises `SystemExit` where limits are not met, or nothing is decided of them."""
    warn((*done.analysed.warnings, *done.doubts))
    if str(json_path) != "-":
        show_result(done.analysed, verbose=verbose)
        show_sections(done.analysed.sections())
    left_behind = (
        labelled(Message("recording"), done.recording, width=9),
        labelled(Message("record"), done.record.id, width=9),
        labelled(Message("report"), done.report, width=9),
    )
    say(*left_behind, err=True)
    say(*done.learned.sentences, err=True)
    left = {"record": done.record.id, "recording": str(done.recording), "report": str(done.report)}
    write_json(done.analysed.as_json() | adopted_json(done.analysed) | left, json_path)
    leave_by(done.analysed.verdict)


def tell_recorded(recording: Path, record: Record, folder: Path, json_path: Path | None) -> None:
    """Say that a run is complete and was calibrated; only a missing report is written.

    Raises `SystemExit` where limits are not met, or nothing is decided of them.
    """
    report = report_path(folder, record)
    done = Message("nothing was done")
    if not has_report(report):
        report_again(folder, record.id, language())
        done = Message("only its report was missing")
    say(
        Message(
            "{recording} is complete, and record {record_id} of it exists: {done}",
            recording=recording,
            record_id=record.id,
            done=done,
        ),
        err=True,
    )
    left = {"record": record.id, "recording": str(recording), "report": str(report)}
    if str(json_path) != "-":
        show_verdict(record.verdict)
    write_json({**record.result, "verdict": record.verdict.as_json(), **left}, json_path)
    leave_by(record.verdict)
