"""A raw file of an accelerometer analysed: fitted, and what is left traced."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Self

from tumble.app.measurement import Measurement
from tumble.app.measurements import check_limits
from tumble.app.methods.dividing_head.summary import details, in_short
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck, Provenance
from tumble.calibrations.core.verdict import Model, Verdict
from tumble.calibrations.core.view import Drawn, Section
from tumble.calibrations.methods.dividing_head.document import document, result_document
from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.methods.dividing_head.judging import judge
from tumble.calibrations.methods.dividing_head.loop.loop import Explained, Loop
from tumble.calibrations.methods.dividing_head.loop.sections import sections
from tumble.calibrations.methods.dividing_head.loop.sentences import comparisons
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.questions import Questioned
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.methods.dividing_head.significance import Kind
from tumble.calibrations.methods.dividing_head.usable import Usable, usable
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.report.document import Report
from tumble.calibrations.tracing.chain import Chain
from tumble.calibrations.tracing.experiments import Experiment


@dataclass(frozen=True, kw_only=True)
class DividingHeadAnalysed:
    """A raw file and what the analysis says of it. Fits `tumble.app.analysed.Analysed`."""

    measurement: Measurement
    asked: Questioned
    """Its rows, with what there was to ask about them."""
    calibration: Calibration
    provenance: Provenance
    limits: tuple[LimitCheck, ...]
    """Of the values to use."""

    @property
    def usable(self) -> Usable:
        """The values to use."""
        return usable(self.calibration)

    @property
    def model(self) -> Model:
        """Whose values are to be used."""
        return self.usable.model

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """The values to use, by name."""
        return self.usable.calibration.parameters

    @property
    def warnings(self) -> tuple[str, ...]:
        """Of the fit."""
        return self.calibration.warnings

    @property
    def verdict(self) -> Verdict:
        """How the unit stands against the limits of its programme."""
        return judge(self.calibration, self.limits)

    @property
    def entry(self) -> Entry:
        """The result as the store takes it."""
        return entry(self.calibration, self.limits, verdict=self.verdict)

    def in_short(self) -> Sequence[str]:
        """One line, and the rows that were set aside."""
        return tuple(in_short(self.usable.calibration))

    def details(self) -> Sequence[str]:
        """Rows, noise, adequacy, and what the experiment supports."""
        return tuple(details(self.usable.calibration))

    def figure(self) -> Drawn:
        """Residuals against the angle."""
        from tumble.calibrations.methods.dividing_head.report.residuals import angle_figure

        return angle_figure(self.usable.calibration)

    def as_json(self) -> dict[str, Any]:
        """The result as `tumble.fit/1`, with the verdict."""
        return result_document(self.calibration, None, self.verdict)


@dataclass(frozen=True, kw_only=True)
class DividingHeadTraced(DividingHeadAnalysed):
    """The same with the loop closed. Fits `tumble.app.analysed.Traced`."""

    loop: Loop
    explained: Explained | None
    """What the loop rests on; None where nothing was traced."""

    @cached_property
    def usable(self) -> Usable:
        """The values to use, by what the loop found."""
        return usable(self.calibration, self.loop)

    @cached_property
    def verdict(self) -> Verdict:
        """How the unit stands against the limits of its programme, by what the loop found."""
        return judge(self.calibration, self.limits, self.loop)

    @property
    def entry(self) -> Entry:
        """The result as the store takes it."""
        return entry(self.calibration, self.limits, self.loop, self.verdict)

    @property
    def next_experiment(self) -> tuple[Experiment, ...]:
        """What to measure next."""
        return self.loop.next_experiment

    @property
    def rows(self) -> Observations:
        """The rows without gross errors."""
        return self.loop.augmented.observations

    @property
    def loop_warnings(self) -> tuple[str, ...]:
        """Of the model with what was found."""
        return self.loop.augmented.warnings

    @property
    def shows_values(self) -> bool:
        """Whether the two models are compared, parameter by parameter."""
        return bool(comparisons(self.loop))

    def sections(self) -> Sequence[Section]:
        """What was found, before and after, and what to measure next."""
        return tuple(sections(self.loop))

    def details(self) -> Sequence[str]:
        """The same but for what values rest on, which the loop says."""
        return tuple(details(self.usable.calibration, elsewhere=(Kind.DEPENDENCE,)))

    def as_json(self) -> dict[str, Any]:
        """The result as `tumble.fit/1`, with verdict and closed loop (`tumble.loop/1`) under `verdict` and `loop`."""
        return result_document(self.calibration, self.loop, self.verdict)

    def loop_json(self) -> dict[str, Any]:
        """The result as `tumble.loop/1`, with the verdict."""
        return document(self.loop, self.verdict)

    def planned(self, experiments: tuple[Experiment, ...]) -> Self:
        """The same with what to measure next."""
        return replace(self, loop=replace(self.loop, next_experiment=experiments))

    def refitted(self, analysed: DividingHeadAnalysed) -> Self:
        """The same with another fit of the same rows."""
        return replace(self, calibration=analysed.calibration)

    def report(self, record_id: str, revision: int, chain: Chain[Any] | None, contradictions: Sequence[str]) -> Report:
        """What is reported of it."""
        from tumble.calibrations.methods.dividing_head.report import calibration_report

        return calibration_report(
            self.calibration,
            self.provenance,
            limits=self.limits,
            record_id=record_id,
            revision=revision,
            loop=self.loop,
            chain=chain,
            contradictions=contradictions,
        )


def traced_with(analysed: DividingHeadAnalysed, loop: Loop, explained: Explained | None) -> DividingHeadTraced:
    """What was analysed, with a loop that was closed on it."""
    limits = check_limits(usable(analysed.calibration, loop).calibration.parameters, analysed.measurement.programme)
    return DividingHeadTraced(**{**vars(analysed), "limits": limits}, loop=loop, explained=explained)
