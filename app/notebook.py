"""What a notebook or a script uses: a few functions, and results that show themselves. All of it is in `tumble` itself.

What goes wrong is an `InputError`, a `JobError`, a `DeviceError` or a `StoreError`: one sentence that says what
happened and what to do.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from tumble.app.analysed import Analysed
from tumble.app.analysing import fit as analyse
from tumble.app.analysing import trace
from tumble.app.calibrating import calibrate as carry_out
from tumble.app.files import is_recording
from tumble.app.jobs import measured_at_stand
from tumble.app.joining import read_together
from tumble.app.measurements import read_measurement
from tumble.app.methods import close_loop as close_tables
from tumble.app.methods import method_of
from tumble.app.names import given_name, given_serial_number
from tumble.app.notebook_result import Picture, Place, Result
from tumble.app.running import Job, Outline, failure
from tumble.app.running import run as measure
from tumble.app.stand import load_stand, read_stand
from tumble.app.stand_lock import holding
from tumble.app.wiring import connect
from tumble.calibrations.core.cells import TableError
from tumble.calibrations.core.method import Method
from tumble.calibrations.core.view import drawn_first
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.procedures.plan import Plan
from tumble.procedures.programme import Programme
from tumble.procedures.programmes import load_programme

if TYPE_CHECKING:
    from tumble.calibrations.allan.result import AllanResult
    from tumble.calibrations.core.reducing import Reduced
    from tumble.calibrations.records.store import Store


def fit(path: Place, *, stand: Place | None = None, serial_number: str = "") -> Result:
    """Fit the declared model to a recording or an observation table.

    Parameters
    ----------
    path
        Recording (`.mcap`) or table (CSV).
    stand
        Stand file, for the budget of a table.
    serial_number
        Of the unit, where the file does not say.
    """
    recorded = read_stand(Path(stand)).recorded if stand else None
    return _of(analyse(read_measurement(Path(path), recorded), serial_number))


def allan(path: Place, *, rate_hz: float | None = None) -> "AllanResult":
    """Allan deviation of every output of a long still recording.

    What it has: `outputs` by the names of their columns, each with `deviations`, `model.coefficients` (N, B, K) and
    `best` (averaging time with its interval); `dwell_s`; `document()`.

    Parameters
    ----------
    path
        Table (CSV) of outputs at equal steps of time, or a recording (`.mcap`), of which the first dwell is used.
    rate_hz
        Samples a second, where a table has no column `time_s`.
    """
    from tumble.calibrations.allan.recording import read_still
    from tumble.calibrations.allan.result import allan as noise_of

    if is_recording(Path(path)):
        from tumble.app.still import read_still_dwell

        return noise_of(read_still_dwell(Path(path)))
    try:
        return noise_of(read_still(Path(path), rate_hz))
    except TableError as error:
        raise InputError(str(error)) from error


def reduce(path: Place) -> "Reduced":
    """Samples of dwells at rest and under vibration (CSV), reduced.

    What it has: `document()` with means, mean products and rectification; `rows(mounting)`, the table that `close_loop`
    reads; `sections()`.

    Raises
    ------
    InputError
        Unreadable or malformed, or no samples of dwells.
    """
    from tumble.app.reducing import reduced_file

    return reduced_file(Path(path))


def close_loop(path: Place, *further: Place, stand: Place | None = None, serial_number: str = "") -> Result:
    """Trace what the declared model leaves to its causes.

    Several recordings and tables of one unit are taken together, in the order in which they were measured; they are not
    corrected by a stand record. A table of a head against a reference, or of parameters against temperature, is traced
    likewise.
    """
    files = [Path(place) for place in (path, *further)]
    method = method_of(files)
    if not measured_at_stand(method.name, files):
        if further:
            raise InputError(Message("{path}: give one table of this kind at a time", path=files[1]))
        return _of_method(method, files)
    recorded = read_stand(Path(stand)).recorded if stand else None
    return _of(trace(analyse(read_together(files, recorded), serial_number)))


def plan(programme: Place, *, stand: Place | None = None) -> Plan:
    """Every step of a programme with its time; nothing moves.

    `programme` is the name of one that comes along, or a file; without `stand` it is planned for the built-in one.
    """
    planned = _programme(programme)
    return Outline(stand=read_stand(_path(stand), planned.method), programme=planned).plan()


def run(
    programme: Place,
    serial_number: str,
    recording: Place,
    *,
    stand: Place | None = None,
    lot: str = "",
    operator: str = "",
    answers: Place | None = None,
) -> Path:
    """Carry out a programme at a stand, the built-in simulated one without `stand`, and leave a recording.

    At a stand that is not simulated a person seats the unit; `answers` is a file that answers for whoever is not there.
    """
    job, path = _job(programme, serial_number, stand, lot, operator), Path(recording)
    with holding(job.stand, serial_number):
        connected = connect(job.stand, _path(answers))
        try:
            outcome = measure(job, connected, path)
        finally:
            connected.links.close()
    if error := failure(outcome, path):
        raise error
    return path


def calibrate(
    programme: Place,
    serial_number: str,
    store: Place,
    *,
    stand: Place | None = None,
    lot: str = "",
    operator: str = "",
    answers: Place | None = None,
) -> Result:
    """Run, fit, close the loop, store and report: the whole job. Record and report lie in the folder `store`.

    `answers` as in `run`.
    """
    job = _job(programme, serial_number, stand, lot, operator)
    with holding(job.stand, serial_number):
        connected = connect(job.stand, _path(answers))
        try:
            return _of(carry_out(job, connected, Path(store)).analysed)
        finally:
            connected.links.close()


def records(store: Place) -> "Store":
    """The records in a folder: `find`, `latest`, `get`. Raises `StoreError`."""
    from tumble.calibrations.records.store import Store

    return Store(Path(store))


def _job(programme: Place, serial_number: str, stand: Place | None, lot: str, operator: str) -> Job:
    wanted = _programme(programme)
    loaded = load_stand(_path(stand), wanted.method)
    return Job(
        stand=loaded,
        programme=wanted,
        serial_number=given_serial_number(serial_number, "serial_number"),
        lot=given_name(lot, "lot"),
        operator=given_name(operator, "operator"),
    )


def _programme(programme: Place) -> Programme:
    return load_programme(programme if isinstance(programme, str) else Path(programme))


def _path(place: Place | None) -> Path | None:
    return None if place is None else Path(place)


def _of(analysed: Analysed) -> Result:
    def draw() -> Picture:
        figure = analysed.figure()
        return Picture(figure.__html__() if figure else "")

    return Result(name=analysed.provenance.serial_number, document=analysed.as_json(), draw=draw)


def _of_method(method: Method, paths: Sequence[Path]) -> Result:
    closed = close_tables(method, paths)

    def draw() -> Picture:
        first = drawn_first(tuple(closed.sections()))
        return Picture(first.figure().__html__() if first and first.figure else "")

    return Result(name=paths[-1].stem, document=closed.document(), draw=draw)
