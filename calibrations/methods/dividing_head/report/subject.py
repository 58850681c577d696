"""What a report is about."""

from dataclasses import dataclass
from functools import cached_property

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck, Provenance
from tumble.calibrations.core.verdict import Verdict
from tumble.calibrations.methods.dividing_head.judging import judge
from tumble.calibrations.methods.dividing_head.loop.loop import Loop
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.methods.dividing_head.usable import Usable, usable
from tumble.calibrations.tracing.chain import Chain


@dataclass(frozen=True, kw_only=True)
class Subject:
    """Everything that a section of the page may draw on."""

    calibration: Calibration
    """The fit of the declared model."""
    provenance: Provenance
    limits: tuple[LimitCheck, ...] = ()
    loop: Loop | None = None
    """None where the loop was not closed."""
    chain: Chain[Loop] | None = None
    """None where nothing was run to close it."""
    decided: Verdict | None = None
    """The verdict, where it is known already."""
    contradictions: tuple[str, ...] = ()
    """Where the loop contradicts the stand record that was applied."""

    @cached_property
    def use(self) -> Usable:
        """The values to use, by what the loop found."""
        return usable(self.calibration, self.loop)

    @cached_property
    def verdict(self) -> Verdict:
        """How the unit stands against the limits of its programme."""
        return self.decided or judge(self.calibration, self.limits, self.loop)

    @property
    def stated(self) -> tuple[Parameter, ...]:
        """The parameters that have a value that may be used."""
        return tuple(parameter for parameter in self.use.calibration.parameters.values() if parameter.value is not None)


def mounts_of(observations: Observations) -> list[str]:
    """The mounts of a table in the order in which they first come."""
    return list(dict.fromkeys(observations.mounts.tolist()))
