"""Going on with a run that was cut off.

What there is of it is kept under another name, `RUN.cut-N.mcap`, and `RUN.mcap` begins anew with everything complete up
to the break. Whatever happens in between, the most complete of these files is the one that counts.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from tumble.app.exits import Exit, JobError
from tumble.app.running import Job, begin_recording, carry_out
from tumble.app.simulation import Past
from tumble.app.stand import LoadedStand
from tumble.app.wiring import Connected
from tumble.drivers.protocols import Identity
from tumble.messages import Message
from tumble.procedures.announcer import Listener
from tumble.procedures.errors import InputError
from tumble.procedures.events import Identified
from tumble.procedures.outcome import Outcome
from tumble.procedures.programme import Programme
from tumble.procedures.programmes import programme_from_text
from tumble.procedures.recording.contents import Said
from tumble.procedures.recording.errors import RecordingError
from tumble.procedures.recording.header import written_version
from tumble.procedures.recording.reader import complete_messages, leading, monotonic_s, read_recording
from tumble.procedures.recording.recorded import Recording

_CUT = re.compile(r"(?P<run>.+)\.cut-(?P<number>\d+)")


@dataclass(frozen=True, kw_only=True)
class Unfinished:
    """A run that can go on."""

    path: Path
    """Where it goes on."""
    recording: Recording
    """The most complete file that there is of it."""
    last: Said | None
    """The last message before the break."""

    @property
    def programme(self) -> Programme:
        """What the run carries out. Raises `InputError` where the recording was altered."""
        header = self.recording.header
        if not header.has_its_programme:
            raise InputError(
                Message(
                    "{path}: its programme is not the one that was begun (its SHA-256 differs); a run goes on with "
                    "its own programme only",
                    path=self.recording.path,
                )
            )
        return programme_from_text(header.programme_text, str(self.recording.path))

    @property
    def elapsed_s(self) -> float:
        """Seconds from the beginning of the run to the break, by the stand's clock."""
        return monotonic_s(self.last) - self.recording.header.started_monotonic_s if self.last else 0.0

    @property
    def identities(self) -> dict[str, Identity]:
        """The instruments with which it was begun."""
        return {
            event.instrument: Identity(model=event.model, serial=event.serial, firmware=event.firmware)
            for event in self.recording.events
            if isinstance(event, Identified)
        }


def find(path: Path) -> Unfinished:
    """Look for what there is of a run, by the name of its recording or of one that was set aside.

    Raises
    ------
    InputError
        There is no such recording, or none that can be read.
    """
    cut = _CUT.fullmatch(path.stem)
    run = path.with_name(cut["run"] + path.suffix) if cut else path
    found: list[Recording] = []
    failure: RecordingError | None = None
    for candidate in (run, *_set_aside_before(run)):
        try:
            found.append(read_recording(candidate))
        except RecordingError as error:
            failure = failure or error
    if not found:
        raise InputError(str(failure))
    best = max(map(leading, found), key=_completeness)
    *_, last = (None, *complete_messages(best))
    return Unfinished(path=run, recording=best, last=last)


def is_set_aside(path: Path) -> bool:
    """Whether a file is what was set aside of a run, by its name."""
    return _CUT.fullmatch(path.stem) is not None


def files_of(run: Path) -> tuple[Path, ...]:
    """The recording of a run, and what was set aside of it; empty where there is neither."""
    return tuple(path for path in (*_set_aside_before(run), run) if path.is_file())


def lived_through(paths: Sequence[Path], stand: LoadedStand, now: Recording | None = None) -> list[Past]:
    """The runs of recordings that were made at a stand, and the one that goes on `now`.

    Where the stand is simulated it has to live through them again; a real one needs nothing of the kind.

    Raises
    ------
    InputError
        A recording cannot be read.
    """
    if not stand.file.simulates:
        return []
    try:
        recordings = [*map(read_recording, paths), *([now] if now else [])]
    except RecordingError as error:
        raise InputError(
            Message("{error}; the simulated stand has to live through that run again", error=error)
        ) from error
    here = [each for each in recordings if each.header.stand_sha256 == stand.sha256]
    return [_past(each, stand, here[0]) for each in here]


def _past(recording: Recording, stand: LoadedStand, first: Recording) -> Past:
    header = recording.header
    programme = programme_from_text(header.programme_text, str(recording.path))
    job = Job(stand=stand, programme=programme, serial_number=header.serial_number)
    return Past(
        programme=programme,
        acquisition=job.acquisition,
        takes=[point.take for point in recording.points],
        began_s=(header.started_wall_ns - first.header.started_wall_ns) / 1e9,
    )


def resume(
    unfinished: Unfinished,
    job: Job,
    connected: Connected,
    listeners: Sequence[Listener] = (),
    tolerance_v: float | None = None,
) -> Outcome:
    """Go on with the run where it was cut off; `STOPPING_SIGNALS` stop it at a safe standstill.

    Parameters
    ----------
    unfinished
        What there is of the run.
    job
        Its programme, unit and stand file.
    connected
        The instruments, and who seats the unit.
    listeners
        Called with every event.
    tolerance_v
        By how much the last point may differ when it is taken again; without it, by what noise explains.

    Raises
    ------
    InputError
        The recording is not the beginning of its programme; nothing has moved, and no file was touched.
    JobError
        A file cannot be set aside or written; nothing has moved.
    """
    recording, clock = unfinished.recording, connected.stand.clock
    job.plan()
    job.check(recording.points)
    elapsed_s = partial(_elapsed_s, unfinished, connected)
    source = _make_room(unfinished)
    recorder = begin_recording(
        unfinished.path,
        replace(recording.header, format_version=written_version(recording.header.method)),
        clock,
        before=complete_messages(replace(recording, path=source)),
        elsewhen_s=recording.header.started_monotonic_s + elapsed_s() - clock.monotonic_s(),
    )
    return carry_out(
        lambda engine: engine.resume(
            job.programme.procedure,
            recording.points,
            elapsed_s=elapsed_s,
            known=unfinished.identities,
            tolerance_v=tolerance_v,
        ),
        job,
        connected,
        recorder,
        listeners,
    )


def _elapsed_s(unfinished: Unfinished, connected: Connected) -> float:
    """Seconds since the run began: up to the break by the stand's clock, from there by the wall clock, if it rose."""
    if connected.lived_s is not None:
        return connected.lived_s
    outage_ns = connected.stand.clock.wall_ns() - unfinished.last.log_time_ns if unfinished.last else 0
    return unfinished.elapsed_s + max(0.0, outage_ns / 1e9)


def _completeness(recording: Recording) -> tuple[int, int]:
    return len(recording.points), len(recording.steps) + len(recording.events) + len(recording.answers)


def _set_aside_before(run: Path) -> list[Path]:
    """Files of a run that were set aside, in their order."""
    numbered = {
        int(cut["number"]): path
        for path in run.parent.glob(f"*.cut-*{run.suffix}")
        if (cut := _CUT.fullmatch(path.stem)) and cut["run"] == run.stem
    }
    return [numbered[number] for number in sorted(numbered)]


def _make_room(unfinished: Unfinished) -> Path:
    """Set aside what has the name of the run; return where what there is of it lies now."""
    run = unfinished.path
    if not run.exists():
        return unfinished.recording.path
    before = _set_aside_before(run)
    last = _CUT.fullmatch(before[-1].stem) if before else None
    aside = run.with_name(f"{run.stem}.cut-{int(last['number']) + 1 if last else 1}{run.suffix}")
    try:
        run.rename(aside)
    except OSError as error:
        sentence = Message(
            "{run}: cannot be renamed to {name} ({reason}); close whatever has it open",
            run=run,
            name=aside.name,
            reason=error.strerror,
        )
        raise JobError(sentence, Exit.STORAGE) from error
    return aside if unfinished.recording.path == run else unfinished.recording.path
