"""A raw file of a triad analysed: fitted, and what is left traced."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from tumble.app.loop_analysed import LoopAnalysed, LoopTraced
from tumble.calibrations.allan import sections as allan_sections
from tumble.calibrations.allan.recording import StillRecording
from tumble.calibrations.allan.result import AllanResult, allan
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.triad.document import document, fit_document
from tumble.calibrations.methods.triad.loop import TriadDeclared, TriadLoop
from tumble.calibrations.methods.triad.method import METHOD
from tumble.calibrations.methods.triad.sections import sections_beside_values


@dataclass(frozen=True, kw_only=True)
class TriadAnalysed(LoopAnalysed):
    """A raw file and what the declared model says of it."""

    method = METHOD
    output_unit = "V"

    declared: TriadDeclared

    def fit_document(self) -> dict[str, Any]:
        """The fourteen parameters as `tumble.fit/1`."""
        return fit_document(self.declared)


@dataclass(frozen=True, kw_only=True)
class TriadTraced(TriadAnalysed, LoopTraced):
    """The same with the loop closed."""

    loop: TriadLoop
    still: StillRecording | None = None
    """What the runs hold of a unit that was left alone."""

    @cached_property
    def noise(self) -> AllanResult | None:
        """How the noise falls with averaging; None without a still recording."""
        return None if self.still is None else allan(self.still)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is to be asked of the run, and what was odd in it and in its noise."""
        return (*super().warnings, *(self.noise.warnings if self.noise else ()))

    def loop_document(self) -> dict[str, Any]:
        """The closed loop as `tumble.loop/1`."""
        return document(self.loop) | ({"allan": self.noise.document()} if self.noise else {})

    def sections(self) -> Sequence[Section]:
        """What was found, before and after, what to measure next, and how long to average."""
        of_the_noise = allan_sections.sections(self.noise) if self.noise else ()
        return (*sections_beside_values(self.loop), *of_the_noise)
