"""A result as the screen Result shows it, worked out where it keeps nobody waiting."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.verdict import Outcome, Verdict
from tumble.window.work.activity import Concluded

if TYPE_CHECKING:
    from tumble.calibrations.report.layers import Sheet
    from tumble.calibrations.report.limit_bar import LimitBar
    from tumble.calibrations.tracing.experiments import Experiment
    from tumble.calibrations.tracing.sentences import Finding


@dataclass(frozen=True, kw_only=True)
class ParameterLine:
    """One parameter, every cell as text."""

    name: str
    value: str
    """Value and expanded uncertainty with the unit; empty where there is none."""
    interval: str
    """The 95% interval."""
    standard: str
    """Standard uncertainty."""
    note: str
    """The condition under which the value stands."""
    reason: str = ""
    """Why there is no value."""
    limits: str = ""
    verdict: str = ""
    outcome: Outcome = Outcome.NO_LIMITS
    words: str = ""
    """What the parameter is called; empty where its method does not say."""
    declared: str = ""
    """Value and expanded uncertainty of the declared model, where others are to be used."""
    bar: "LimitBar | None" = None
    """How it lies between its limits; None where it has none."""
    change: str = ""
    """Since the last calibration; empty where there was none."""
    since: str = ""
    """Day of that one."""


@dataclass(frozen=True, kw_only=True)
class Correlations:
    """Correlation coefficients of the parameters."""

    names: Sequence[str]
    coefficients: FloatArray
    """Shape (names, names)."""
    texts: Sequence[Sequence[str]]
    """The same as text, empty where there is none."""


@dataclass(frozen=True, kw_only=True)
class Drawn:
    """A figure of the result."""

    title: str
    svg: str
    """In the language of the window; empty where it is drawn as plots."""
    caption: str
    sheet: "Sheet | None" = None
    """What there is to plot."""


@dataclass(frozen=True, kw_only=True)
class LoopSummary:
    """What the closed loop says; what is empty is not shown."""

    experiments: "Sequence[Experiment]"
    """What to measure next, the best first."""
    headline: str = ""
    findings: "Sequence[Finding]" = ()
    comparisons: Sequence[tuple[str, str, str, str]] = ()
    """Name, declared model, with what was found, change."""
    figures: Sequence[Drawn] = ()
    """The residual before and after."""
    not_identifiable: Sequence[tuple[str, str]] = ()
    """Names, and why."""
    dependence: str = ""
    """Which parameters rest on another one alone."""


@dataclass(frozen=True, kw_only=True)
class Presentation:
    """Everything on the screen Result but the words of the window itself."""

    concluded: Concluded
    verdict: Verdict
    notices: Sequence[str]
    table: Sequence[ParameterLine]
    picture: Drawn | None = None
    """The figure that says most, for whoever looks before reading: it stands below the values."""
    correlations: Correlations | None = None
    loop: LoopSummary | None = None
