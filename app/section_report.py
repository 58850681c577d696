"""The report of a result that is shown by its sections."""

from collections.abc import Sequence
from typing import Any, Protocol

from tumble.app.measurement import Measurement
from tumble.calibrations.core.provenance import Provenance
from tumble.calibrations.core.view import Section
from tumble.calibrations.tracing.chain import Chain
from tumble.calibrations.tracing.chain_sections import chain_section
from tumble.messages import Message


class Shown(Protocol):
    """What a traced result has to say of itself to be reported so."""

    @property
    def measurement(self) -> Measurement:
        """What was measured."""
        ...

    @property
    def provenance(self) -> Provenance:
        """Whose result it is."""
        ...

    @property
    def warnings(self) -> tuple[str, ...]:
        """What was odd in the rows."""
        ...

    @property
    def loop_warnings(self) -> tuple[str, ...]:
        """What was odd when the loop was closed."""
        ...

    def sections(self) -> Sequence[Section]:
        """What is shown, the answer first."""
        ...


def section_report(
    title: str, traced: Shown, record_id: str, chain: Chain[Any] | None, contradictions: Sequence[str]
) -> str:
    """One HTML page, with the experiments that closed the loop; `title` says what was calibrated."""
    from tumble.calibrations.report.sections import page  # jinja2 takes time

    record = Message("record {name}", name=record_id) if record_id else ""
    stand_record = traced.measurement.stand_record
    applied = stand_record.applied if stand_record else ""
    notices = [*filter(None, [record, applied]), *traced.warnings, *traced.loop_warnings, *contradictions]
    sections = [*traced.sections(), *([chain_section(chain)] if chain else [])]
    return page(title, traced.provenance.serial_number, sections, notices)
