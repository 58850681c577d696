"""Puts the chapters together into one report."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Final

from tumble.calibrations.core.provenance import LimitCheck, Provenance
from tumble.calibrations.core.view import Chapter, Section
from tumble.calibrations.methods.dividing_head.loop.loop import Loop
from tumble.calibrations.methods.dividing_head.quantities import QUANTITIES
from tumble.calibrations.methods.dividing_head.report import evidence, uncertainty
from tumble.calibrations.methods.dividing_head.report.loop import loop_sections
from tumble.calibrations.methods.dividing_head.report.results import notices, result_sections
from tumble.calibrations.methods.dividing_head.report.stand import stand_sections
from tumble.calibrations.methods.dividing_head.report.subject import Subject
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.report.conditions import temperatures_degc
from tumble.calibrations.report.document import Front, Report
from tumble.calibrations.report.origin import origin
from tumble.calibrations.tracing.chain import Chain
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class Part:
    """What a chapter is made of."""

    anchor: str
    title: str
    sections: Callable[[Subject], Iterable[Section]]

    def chapter(self, subject: Subject) -> Chapter:
        """The chapter of one report."""
        return Chapter(anchor=self.anchor, title=self.title, sections=tuple(self.sections(subject)))


PARTS: Final = (
    Part(anchor="results", title=Message("Results"), sections=result_sections),
    Part(
        anchor="significance",
        title=Message("Significance and identifiability"),
        sections=evidence.significance_sections,
    ),
    Part(anchor="loop", title=Message("What the model left unexplained"), sections=loop_sections),
    Part(anchor="stand", title=Message("Corrections of the stand"), sections=stand_sections),
    Part(anchor="residuals", title=Message("Residuals of the declared model"), sections=evidence.residual_sections),
    Part(anchor="closure", title=Message("Closure of the flips"), sections=evidence.closure_sections),
    Part(
        anchor="quality",
        title=Message("Noise and lack of fit of the declared model; rows"),
        sections=evidence.quality_sections,
    ),
    Part(anchor="budget", title=Message("Uncertainty budget"), sections=uncertainty.budget_sections),
    Part(anchor="correlation", title=Message("Correlation"), sections=uncertainty.correlation_sections),
    Part(
        anchor="published",
        title=Message("Comparison with the published method"),
        sections=uncertainty.published_sections,
    ),
)
"""The chapters after the first page, in their order; provenance follows."""


def calibration_report(
    calibration: Calibration,
    provenance: Provenance,
    *,
    limits: Sequence[LimitCheck] = (),
    record_id: str = "",
    revision: int = 1,
    loop: Loop | None = None,
    chain: Chain[Loop] | None = None,
    contradictions: Sequence[str] = (),
) -> Report:
    """What is reported of a calibration.

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
        loop=loop,
        chain=chain,
        contradictions=tuple(contradictions),
    )
    return Report(
        kind=Message("Calibration of an accelerometer on a dividing head"),
        title=provenance.serial_number,
        front=Front(
            provenance=provenance,
            parameters=subject.use.calibration.parameters,
            verdict=subject.verdict,
            quantities=QUANTITIES,
            limits=subject.limits,
            record_id=record_id,
            revision=revision,
            picture=evidence.fit_picture(calibration),
            temperatures_degc=temperatures_degc(calibration.observations),
        ),
        notices=notices(subject),
        chapters=(*(part.chapter(subject) for part in PARTS), origin(provenance)),
    )
