"""A report in words: every text in one language, every figure as SVG, ready for a page or for paper."""

import re
from collections.abc import Sequence
from datetime import date
from pathlib import PurePath
from typing import Any, Final

from tumble.calibrations.core.verdict import Outcome
from tumble.calibrations.core.view import Chapter, Section
from tumble.calibrations.report.dates import dated, day_of
from tumble.calibrations.report.document import Front, Report
from tumble.calibrations.report.instruments import Instrument, instruments, laboratory
from tumble.calibrations.report.language import language, say
from tumble.calibrations.report.statements import statements, states_expanded
from tumble.calibrations.report.values import coverage, values
from tumble.calibrations.report.verdicts import JUDGED, MARKS, headline
from tumble.messages import AsWritten, Message

_NUMERIC: Final = re.compile(r"[<>≈×]?\s*[-+−(]?\d")
"""How a cell begins that is set to the right."""
_LABELS: Final = {
    "read_first": Message("Read this first"),
    "sections": Message("Sections"),
    "values": Message("Values to use"),
    "quantity": Message("Quantity"),
    "limits": Message("Limits"),
    "verdict": Message("Verdict"),
    "instruments": Message("Instruments"),
    "page": Message("page {page} of {pages}", page="{page}", pages="{pages}"),
    "reset": Message("whole figure"),
    "hint": Message(
        "Drag, or wheel with Ctrl: zoom. Double click: whole figure. The nearest value stands at the pointer. Keys: "
        "arrows go from value to value, + and - zoom, Shift with arrows moves, 0 is the whole figure."
    ),
    "issued": Message("Place and date"),
    "authorised": Message("Name and signature"),
}
"""What stands in every report."""


def written(report: Report) -> dict[str, Any]:
    """All that a report says, in the language of the page that is written; figures and bars are SVG."""
    front = report.front
    return {
        "language": str(language()),
        "labels": {name: say(text) for name, text in _LABELS.items()},
        "kind": say(report.kind),
        "title": report.title,
        "front": _front(front) if front else None,
        "notices": list(dict.fromkeys(map(_without_path, report.notices))),
        "chapters": [_chapter(each) for each in report.chapters if any(not part.empty for part in each.sections)],
    }


def _front(front: Front) -> dict[str, Any]:
    outcome = front.verdict.outcome
    name, address = laboratory(front.provenance.stand)
    return {
        "record": front.record_id,
        "laboratory": name,
        "address": address,
        "outcome": str(outcome),
        "word": say(outcome.words).upper(),
        "headline": " ".join(filter(None, [MARKS[outcome], say(headline(front.verdict))])),
        "judged": "" if outcome is Outcome.NO_LIMITS else say(JUDGED[front.verdict.judged]),
        "decided": [
            say(Message("{name}: {reason}", name=each.name, reason=each.reason))
            for each in front.verdict.parameters
            if each.outcome is Outcome.NOT_DECIDED
        ],
        "facts": [(say(name), text) for name, text in _facts(front).items() if text],
        "values": [
            {name: text if name == "bar" else say(text) for name, text in vars(each).items()} for each in values(front)
        ],
        "limited": bool(front.limits),
        "covered": any(coverage(each) for each in front.parameters.values()),
        "stated_as": say(Message("Value ± U") if states_expanded(front) else Message("Value")),
        "picture": front.picture
        and {"svg": str(front.picture.figure.__html__()), "caption": say(front.picture.caption)},
        "instruments": _instruments(front),
        "statements": [say(each) for each in statements(front)],
    }


def _facts(front: Front) -> dict[str, str]:
    provenance = front.provenance
    return {
        Message("Measured"): dated(provenance.measured_at, language()),
        Message("Temperature"): _temperature(front.temperatures_degc),
        Message("Lot"): provenance.lot,
        Message("Operator"): provenance.operator,
        Message("Programme"): provenance.programme_name,
        Message("Stand"): provenance.stand_name,
        Message("Record"): _record(front),
    }


def _temperature(range_degc: tuple[float, float] | None) -> str:
    """To a tenth of a kelvin; one number where both ends are the same."""
    ends = dict.fromkeys(f"{end:.1f}" for end in range_degc or ())
    return say(f"{' to '.join(ends)} °C") if ends else ""


def _record(front: Front) -> str:
    """The record and, behind a comma, its revision where it is not the first."""
    if front.revision == 1 or not front.record_id:
        return front.record_id
    return say(Message("{record}, revision {revision}", record=AsWritten(front.record_id), revision=front.revision))


def _instruments(front: Front) -> dict[str, Any] | None:
    """The table of the instruments; columns in which nothing is stated are left out."""
    found = list(instruments(front.provenance.stand))
    columns = {
        Message("Instrument"): [say(each.name) for each in found],
        Message("Driver"): [each.driver for each in found],
        Message("Serial number"): [each.serial for each in found],
        Message("Certificate"): [each.certificate for each in found],
        Message("Calibration due"): [_due(each, day_of(front.provenance.measured_at)) for each in found],
    }
    shown = {say(name): cells for name, cells in columns.items() if any(cells)}
    return {"headings": list(shown), "rows": list(zip(*shown.values(), strict=True))} if found else None


def _due(instrument: Instrument, measured: date | None) -> str:
    """By when it was to be calibrated, and whether that day was past when the unit was measured."""
    due = dated(instrument.due, language())
    return say(Message("{date}, overdue", date=due)) if measured and instrument.overdue(measured) else due


def _without_path(notice: str) -> str:
    """A notice without the file that it begins with, and others by their names alone: where they lay is provenance."""
    if not isinstance(notice, Message):
        return say(notice)
    named = _named_shortly(notice)
    said, source = say(named), named.fields.get("source")
    rest = said.removeprefix(f"{source}: ") if source else said
    return rest if rest == said else rest[:1].upper() + rest[1:]


def _named_shortly(message: Message) -> Message:
    """A message in which no file has the folder in which it lies."""
    fields = {name: _short(name, field) for name, field in message.fields.items()}
    return type(message).of_parts(message.template, message.plural, fields)


def _short(name: str, field: object) -> object:
    if isinstance(field, Message):
        return _named_shortly(field)
    return AsWritten(PurePath(str(field)).name) if name in ("source", "path") else field


def _chapter(chapter: Chapter) -> dict[str, Any]:
    shown = [section for section in chapter.sections if not section.empty]
    return {
        "anchor": chapter.anchor,
        "title": say(chapter.title),
        "sections": [written_section(each) for each in shown],
    }


def written_section(section: Section) -> dict[str, Any]:
    """A section in the language of the page that is written."""
    headings, table = _without_empty(section.headings, section.rows)
    rows = [[say(cell) for cell in row] for row in table]
    return {
        "title": say(section.title),
        "lines": [say(line) for line in section.lines],
        "svg": str(section.figure().__html__()) if section.figure else "",
        "caption": say(section.caption),
        "headings": [say(heading) for heading in headings],
        "rows": rows,
        "right": _set_right(table),
        "code": section.code,
    }


def _without_empty(
    headings: Sequence[str], rows: Sequence[Sequence[str]]
) -> tuple[Sequence[str], Sequence[Sequence[str]]]:
    """A table without the columns in which no line has anything; the first names the line."""
    filled = {place for row in rows for place, cell in enumerate(row) if cell}
    kept = [place for place in range(_widest(rows)) if place == 0 or place in filled]
    of_headings = [headings[place] for place in kept if place < len(headings)]
    return of_headings, [[row[place] for place in kept if place < len(row)] for row in rows]


def _set_right(rows: Sequence[Sequence[str]]) -> list[bool]:
    """Which columns hold numbers in most of their cells, the empty ones not counted; the first names the line."""
    columns = [[row[place] for row in rows if place < len(row) and row[place]] for place in range(_widest(rows))]
    return [place > 0 and _mostly_numbers(cells) for place, cells in enumerate(columns)]


def _widest(rows: Sequence[Sequence[str]]) -> int:
    return max(map(len, rows), default=0)


def _mostly_numbers(cells: Sequence[str]) -> bool:
    """Of texts that are `AsWritten`, such as hashes and what a file says, none is a number."""
    return 2 * sum(bool(_NUMERIC.match(cell)) for cell in cells if not isinstance(cell, AsWritten)) > len(cells)
