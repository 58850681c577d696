"""Tables that were measured elsewhere, as the screen Result shows them.

Every function is called outside the event loop. Analysis and store are imported when they are called: a window is up
before that.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck, Provenance
from tumble.calibrations.core.verdict import Verdict
from tumble.calibrations.core.view import Section
from tumble.calibrations.records.entry import NOT_JUDGED
from tumble.window.look.language import spoken
from tumble.window.work.activity import Concluded

if TYPE_CHECKING:
    from tumble.calibrations.core.method import Method, Result
    from tumble.calibrations.records.record import Record
    from tumble.calibrations.tracing.experiments import Experiment


@dataclass(frozen=True, kw_only=True)
class TableResult:
    """What the closed loop on tables says; no programme limits it, and no stand here could measure further."""

    result: "Result"
    provenance: Provenance
    limits: ClassVar[tuple[LimitCheck, ...]] = ()
    next_experiment: ClassVar[tuple["Experiment", ...]] = ()
    verdict: ClassVar[Verdict] = NOT_JUDGED

    @property
    def warnings(self) -> Sequence[str]:
        """Sentences to be read first."""
        return self.result.warnings

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """The values to use, by name."""
        return self.result.parameters

    def sections(self) -> Sequence[Section]:
        """What is shown of it, the answer first."""
        return self.result.sections()


def analyse(method: "Method", files: Sequence[Path], folder: Path) -> Concluded:
    """Trace tables of one unit, store what comes of it with its report. Raises `InputError`, `JobError`."""
    from tumble.app.calibrating import make_ready
    from tumble.app.kept_reports import report_path
    from tumble.app.methods import close_loop
    from tumble.app.storing import record_tables, report_tables

    make_ready(folder)
    result = close_loop(method, files)
    record = record_tables(result, files, folder)
    page = report_path(folder, record)
    report_tables(method, result, record, folder, page, spoken())
    return _concluded(result, record, files, page)


def recall(record: "Record", files: Sequence[Path], folder: Path) -> Concluded:
    """Work out again what a record of tables says. Raises `InputError`, `RecordError`."""
    from tumble.app.kept_reports import report_path
    from tumble.app.storing import traced_again

    _, result = traced_again(record, files)
    return _concluded(result, record, files, report_path(folder, record))


def _concluded(result: "Result", record: "Record", files: Sequence[Path], page: Path) -> Concluded:
    return Concluded(
        method=record.method,
        traced=TableResult(result=result, provenance=record.provenance),
        recordings=tuple(files),
        record_id=record.id,
        report=page if page.is_file() else None,
    )
