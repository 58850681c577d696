"""Two records held against each other, put into words where that keeps nobody waiting."""

from collections.abc import Callable

from tumble.calibrations.core.quantities import format_quantity
from tumble.calibrations.records.compare import Difference, compare
from tumble.calibrations.records.parameter import RecordedParameter
from tumble.calibrations.records.record import Record
from tumble.calibrations.records.unlike import unlike
from tumble.window.look.moments import written_moment_text
from tumble.window.look.numbers import local
from tumble.window.look.sentences import in_language
from tumble.window.work.compared import ComparedLine, Comparison, Interval
from tumble.window.work.preview import value_text
from tumble.window.work.record_words import programme_text


def comparison(first: Record, second: Record) -> Comparison:
    """Hold the values to use against each other. Raises `RecordError` where the records are of different methods."""
    lines = [_line(each, first.values.get(each.name), second.values.get(each.name)) for each in compare(first, second)]
    ways: tuple[Callable[[Record], str], ...] = (_moment_text, programme_text, lambda each: each.id)
    beside = next(way for way in ways if way(first) != way(second) or way is ways[-1])
    return Comparison(
        first=_called(first, beside(first)),
        second=_called(second, beside(second)),
        unlike=tuple(map(in_language, unlike(first, second))),
        lines=lines,
    )


def _moment_text(record: Record) -> str:
    return written_moment_text(record.provenance.measured_at)


def _line(found: Difference, a: RecordedParameter | None, b: RecordedParameter | None) -> ComparedLine:
    return ComparedLine(
        name=found.name,
        first=_told(a),
        second=_told(b),
        difference=_difference(found),
        ratio="" if found.significance is None else local(f"{found.significance:+.2f}"),
        sentence=in_language(found.sentence),
        conclusion=in_language(found.conclusion),
        intervals=(_interval(a, found.unit), _interval(b, found.unit)),
    )


def _difference(found: Difference) -> str:
    if found.difference is None or found.standard_uncertainty is None:
        return ""
    return in_language(format_quantity(found.difference, found.expanded_uncertainty, found.unit))


def _interval(parameter: RecordedParameter | None, unit: str) -> Interval | None:
    if parameter is None or parameter.value is None or parameter.interval_95 is None or parameter.unit != unit:
        return None
    low, high = parameter.interval_95
    return Interval(value=parameter.value, low=low, high=high)


def _told(parameter: RecordedParameter | None) -> str:
    return in_language(value_text(parameter)) if parameter else ""


def _called(record: Record, text: str) -> str:
    """By its unit, and by what tells it from the other one."""
    return ", ".join(filter(None, (record.provenance.serial_number, text)))
