"""What a report is about."""

from dataclasses import dataclass

from calibrations.provenance import LimitCheck, Provenance
from calibrations.result import Calibration, Parameter
from calibrations.tracing.chain import Chain
from calibrations.tracing.loop import Loop


@dataclass(frozen=True, kw_only=True)
class Subject:
    """Everything that a section of the page may draw on."""

    calibration: Calibration
    provenance: Provenance
    limits: tuple[LimitCheck, ...] = ()
    record_id: str = ""
    """Empty where the result is in no store."""
    revision: int = 1
    loop: Loop | None = None
    """None where the loop was not closed."""
    chain: Chain | None = None
    """None where nothing was run to close it."""
    contradictions: tuple[str, ...] = ()
    """Where the loop contradicts the stand record that was applied."""

    @property
    def told(self) -> tuple[Parameter, ...]:
        """The parameters that have a value."""
        return tuple(parameter for parameter in self.calibration.parameters.values() if parameter.value is not None)
