"""The report of a result that is shown by its sections."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Protocol

from tumble.app.measurement import Measurement
from tumble.calibrations.core.method import Method, Result, Worded
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck, Provenance
from tumble.calibrations.core.verdict import Verdict
from tumble.calibrations.core.view import Chapter, Quantity, Section, drawn_first
from tumble.calibrations.records.entry import NOT_JUDGED
from tumble.calibrations.report.conditions import temperatures_degc
from tumble.calibrations.report.document import Front, Picture, Report
from tumble.calibrations.report.origin import origin
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
    def parameters(self) -> Mapping[str, Parameter]:
        """The values to use, by name."""
        ...

    @property
    def limits(self) -> tuple[LimitCheck, ...]:
        """Those values held against the limits of the programme."""
        ...

    @property
    def verdict(self) -> Verdict:
        """How the unit stands against them."""
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
    method: Method,
    traced: Shown,
    record_id: str,
    revision: int,
    chain: Chain[Any] | None,
    contradictions: Sequence[str],
) -> Report:
    """What is reported of a unit, with the experiments that closed the loop."""
    stand_record = traced.measurement.stand_record
    applied = [stand_record.applied] if stand_record else []
    sections = [*traced.sections(), *([replace(chain_section(chain), brief=True)] if chain else [])]
    picture, others = _with_picture(sections)
    return Report(
        kind=method.title,
        title=traced.provenance.serial_number,
        front=Front(
            provenance=traced.provenance,
            parameters=traced.parameters,
            verdict=traced.verdict,
            quantities=quantities(method),
            limits=traced.limits,
            record_id=record_id,
            revision=revision,
            picture=picture,
            temperatures_degc=temperatures_degc(traced.measurement.observations),
        ),
        notices=list(dict.fromkeys([*applied, *traced.warnings, *traced.loop_warnings, *contradictions])),
        chapters=tuple(_chapters(others, traced.provenance)),
    )


def table_report(method: Method, result: Result, provenance: Provenance, name: str, record_id: str = "") -> Report:
    """What is reported of tables that were measured elsewhere; `name` is that of the last file."""
    picture, others = _with_picture(result.sections())
    return Report(
        kind=method.title,
        title=Path(name).name,
        front=Front(
            provenance=provenance,
            parameters=result.parameters,
            verdict=NOT_JUDGED,
            quantities=quantities(result) or quantities(method),
            record_id=record_id,
            picture=picture,
        ),
        notices=list(dict.fromkeys(result.warnings)),
        chapters=tuple(_chapters(others, provenance)),
    )


def quantities(whose: Method | Result) -> Mapping[str, Quantity]:
    """What the parameters of a method or a result are called; none where it does not say."""
    return whose.quantities if isinstance(whose, Worded) else {}


def _with_picture(sections: Sequence[Section]) -> tuple[Picture | None, Sequence[Section]]:
    """The figure of the answer, or else the first one, for the first page; and the sections without it."""
    chosen = drawn_first(sections)
    if chosen is None or chosen.figure is None:
        return None, sections
    caption = (
        Message("{title}. {caption}", title=chosen.title, caption=chosen.caption) if chosen.caption else chosen.title
    )
    picture = Picture(figure=chosen.figure(), caption=caption)
    return picture, [replace(each, figure=None, caption="") if each is chosen else each for each in sections]


def _chapters(sections: Sequence[Section], provenance: Provenance) -> Iterator[Chapter]:
    answers = tuple(section for section in sections if section.brief)
    details = tuple(section for section in sections if not section.brief)
    yield Chapter(anchor="analysis", title=Message("Analysis"), sections=answers)
    yield Chapter(anchor="details", title=Message("Details"), sections=details)
    yield origin(provenance)
