"""What a report says, whatever it is written as."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck, Provenance
from tumble.calibrations.core.verdict import Verdict
from tumble.calibrations.core.view import Chapter, Drawn, Quantity, Section

if TYPE_CHECKING:
    from tumble.calibrations.records.changes import Change


@dataclass(frozen=True, kw_only=True)
class Picture:
    """The one figure of the first page."""

    figure: Drawn
    caption: str


@dataclass(frozen=True, kw_only=True)
class Front:
    """The page for the customer."""

    provenance: Provenance
    parameters: Mapping[str, Parameter]
    """The values to use, by name."""
    verdict: Verdict
    quantities: Mapping[str, Quantity] = field(default_factory=dict)
    """What the parameters are called; one that is not among them is called by its name."""
    limits: Sequence[LimitCheck] = ()
    record_id: str = ""
    """Empty where the result is in no store."""
    revision: int = 1
    picture: Picture | None = None
    temperatures_degc: tuple[float, float] | None = None
    """The lowest and the highest while it was measured; None where nothing told it."""
    changes: "Mapping[str, Change]" = field(default_factory=dict)
    """Of the values since the unit was calibrated before, by name; one that is not among them has no earlier value."""


@dataclass(frozen=True, kw_only=True)
class Report:
    """A report; one without a front is a page of sections."""

    kind: str
    """What was calibrated, in words."""
    title: str
    """Serial number of the unit, or what else the page is about."""
    front: Front | None = None
    notices: Sequence[str] = ()
    """What the reader must know before the numbers, a sentence each."""
    chapters: Sequence[Chapter] = ()

    def with_changes(self, changes: "Mapping[str, Change]") -> "Report":
        """The same, with what has changed since the unit was calibrated before; the same where it has no front."""
        return replace(self, front=replace(self.front, changes=changes)) if self.front else self


def page_of_sections(kind: str, title: str, sections: Sequence[Section], notices: Sequence[str] = ()) -> Report:
    """A page without a front, its sections one after the other."""
    chapters = [
        Chapter(anchor=f"s{number}", title=section.title, sections=(replace(section, title=""),))
        for number, section in enumerate(sections, start=1)
    ]
    return Report(kind=kind, title=title, notices=notices, chapters=chapters)
