"""A result with its figures, drawn where that keeps nobody waiting."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from tumble.calibrations.core.view import Section, drawn_first
from tumble.window.generic.presenting import SectionPresentation
from tumble.window.generic.presenting import present as present_sections
from tumble.window.look.language import spoken
from tumble.window.work.activity import Concluded
from tumble.window.work.presentation import Drawn, Presentation


@dataclass(frozen=True, kw_only=True)
class DrawnPresentation(SectionPresentation):
    """What the tab Pictures shows beside."""

    figures: Sequence[Drawn]


def figures_of(presentation: Presentation) -> Sequence[Drawn]:
    """The figures of a result that was presented here."""
    assert isinstance(presentation, DrawnPresentation), "a result is shown by the part that presented it"
    return presentation.figures


def present(concluded: Concluded) -> DrawnPresentation:
    """Work out what there is to show."""
    plain = present_sections(concluded)
    shown = [section for section in plain.sections if section.figure]
    figures, first = drawn_of(shown), drawn_first(shown)
    picture = next((figure for section, figure in zip(shown, figures, strict=True) if section is first), None)
    return DrawnPresentation(**vars(replace(plain, picture=picture)), figures=figures)


def drawn_of(sections: Iterable[Section]) -> tuple[Drawn, ...]:
    """The figures of those sections that have one."""
    return tuple(_drawn(section) for section in sections if section.figure)


def _drawn(section: Section) -> Drawn:
    from tumble.calibrations.report.language import written_in
    from tumble.calibrations.report.layers import Sheet
    from tumble.window.generic.panel_plot import plottable

    assert section.figure is not None, "it has one"
    figure = section.figure()
    if isinstance(figure, Sheet) and plottable(figure):
        return Drawn(title=section.title, svg="", caption=section.caption, sheet=figure)
    with written_in(spoken()):
        return Drawn(title=section.title, svg=figure.__html__(), caption=section.caption)
