"""A result as its method presents it, and what stands beside the values of any method: bars, and what has changed.

Called outside of the event loop. Analysis and store are imported when it is called: a window is up before that.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck
from tumble.calibrations.core.quantities import format_expanded
from tumble.calibrations.core.verdict import Model, Verdict
from tumble.window.look.language import spoken
from tumble.window.work.activity import Concluded
from tumble.window.work.presentation import Presentation

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tumble.calibrations.records.record import Record
    from tumble.calibrations.report.limit_bar import LimitBar


class Limited(Protocol):
    """What a result of any method has to say of its values."""

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """The values to use, by name."""
        ...

    @property
    def limits(self) -> "Sequence[LimitCheck]":
        """Those held against the limits of the programme."""
        ...

    @property
    def verdict(self) -> Verdict:
        """How the unit stands against them."""
        ...


def presented(present: Callable[[Concluded], Presentation], concluded: Concluded, folder: Path) -> Presentation:
    """What `present`, the method's own, shows of a result, with what method and store in `folder` add to its values."""
    from tumble.app.opening import open_store

    shown = present(concluded)
    bars, words = _bars(concluded.traced), _words(concluded.method)
    record = open_store(folder).get(concluded.record_id) if concluded.record_id else None
    changed, declared = _changes(folder, record), _declared(record)
    lines = [
        replace(
            line,
            words=words.get(line.name, ""),
            bar=bars.get(line.name),
            change=changed.get(line.name, ("", ""))[0],
            since=changed.get(line.name, ("", ""))[1],
            declared=declared.get(line.name, ""),
        )
        for line in shown.table
    ]
    return replace(shown, table=lines, notices=(*shown.notices, *_doubts(folder, record)))


def _words(method: str) -> dict[str, str]:
    """What the parameters of a method are called, by their names; nothing of a method that is not installed."""
    from tumble.app.methods import method_called
    from tumble.app.section_report import quantities

    try:
        named = quantities(method_called(method))
    except LookupError:
        return {}
    return {name: quantity.words for name, quantity in named.items()}


def _bars(traced: Limited) -> "dict[str, LimitBar]":
    """Of the parameters that have limits."""
    from tumble.calibrations.report.limit_bar import limit_bar

    return {
        check.name: limit_bar(traced.parameters[check.name], check, judged.outcome)
        for check in traced.limits
        if (judged := traced.verdict.of(check.name)) and check.name in traced.parameters
    }


def _changes(folder: Path, record: "Record | None") -> dict[str, tuple[str, str]]:
    """What has moved since the last calibration, and its day, by name; nothing of a result that is in no store."""
    from tumble.app.last_calibration import changes_since
    from tumble.calibrations.report.values import day_since

    changes = changes_since(folder, record) if record else {}
    return {name: (change.text, day_since(change, spoken())) for name, change in changes.items()}


def _doubts(folder: Path, record: "Record | None") -> tuple[str, ...]:
    """What earlier records of the unit say otherwise of it."""
    from tumble.app.last_calibration import other_lots

    return other_lots(folder, record) if record else ()


def _declared(record: "Record | None") -> dict[str, str]:
    """Value and expanded uncertainty of the declared model, by name, where others are to be used."""
    told = record.parameters.values() if record and record.model is Model.AUGMENTED else ()
    return {
        each.name: format_expanded(each.value, each.interval_95, each.unit)
        for each in told
        if each.value is not None and each.interval_95 is not None
    }
