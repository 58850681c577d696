"""Puts the sections together into one page."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from markupsafe import Markup

from tumble.calibrations.core.provenance import LimitCheck, Provenance
from tumble.calibrations.methods.dividing_head.loop.loop import Loop
from tumble.calibrations.methods.dividing_head.report import evidence, uncertainty
from tumble.calibrations.methods.dividing_head.report.loop import closed_loop
from tumble.calibrations.methods.dividing_head.report.origin import origin
from tumble.calibrations.methods.dividing_head.report.results import header, results
from tumble.calibrations.methods.dividing_head.report.stand import corrections_of_the_stand
from tumble.calibrations.methods.dividing_head.report.subject import Subject
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.report.templates import templates
from tumble.calibrations.tracing.chain import Chain
from tumble.messages import Message

_PACKAGE = "tumble.calibrations.methods.dividing_head"


@dataclass(frozen=True, kw_only=True)
class Section:
    """One section of the page."""

    anchor: str
    title: str
    content: Callable[[Subject], Mapping[str, Any]]

    def render(self, subject: Subject) -> Markup:
        """The section without its heading: the template `<anchor>.html.j2` with what `content` gives."""
        return Markup(templates(_PACKAGE).get_template(f"{self.anchor}.html.j2").render(self.content(subject)))


SECTIONS = (
    Section(anchor="results", title=Message("Results"), content=results),
    Section(anchor="significance", title=Message("Significance and identifiability"), content=evidence.significance),
    Section(anchor="loop", title=Message("What the model left unexplained"), content=closed_loop),
    Section(anchor="stand", title=Message("Corrections of the stand"), content=corrections_of_the_stand),
    Section(anchor="fit", title=Message("Fit"), content=evidence.fit),
    Section(anchor="residuals", title=Message("Residuals"), content=evidence.residuals),
    Section(anchor="closure", title=Message("Closure of the flips"), content=evidence.closure),
    Section(anchor="quality", title=Message("Noise, lack of fit and rows"), content=evidence.quality),
    Section(anchor="budget", title=Message("Uncertainty budget"), content=uncertainty.budget),
    Section(anchor="correlation", title=Message("Correlation"), content=uncertainty.correlation),
    Section(anchor="published", title=Message("Comparison with the published method"), content=uncertainty.published),
    Section(anchor="origin", title=Message("Provenance"), content=origin),
)
"""The sections of the page in their order."""


def render_report(
    calibration: Calibration,
    provenance: Provenance,
    *,
    limits: Sequence[LimitCheck] = (),
    record_id: str = "",
    revision: int = 1,
    loop: Loop | None = None,
    chain: Chain[Loop] | None = None,
    contradictions: Sequence[str] = (),
) -> str:
    """One HTML page that needs nothing else: style and plots are inside, there is no script.

    The same input gives the same text; within `written_in` it is in that language.

    Parameters
    ----------
    calibration
        Result of the analysis.
    provenance
        Where it comes from.
    limits
        Limits of the programme; without them there is no verdict.
    record_id
        Identifier in the store; empty where there is none.
    revision
        Revision of the record, from 1.
    loop
        The loop closed on the same table; None where it was not.
    chain
        The experiments that were run for that; None where it was closed on what was there.
    contradictions
        Where the loop contradicts the stand record that was applied, in words.
    """
    subject = Subject(
        calibration=calibration,
        provenance=provenance,
        limits=tuple(limits),
        record_id=record_id,
        revision=revision,
        loop=loop,
        chain=chain,
        contradictions=tuple(contradictions),
    )
    bodies = [(section, section.render(subject)) for section in SECTIONS]
    return templates(_PACKAGE).get_template("page.html.j2").render(subject=subject, sections=bodies, **header(subject))
