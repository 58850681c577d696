"""What a calibration says: frozen data, the same for record, report, terminal and JSON."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.budget import BudgetLine
from tumble.calibrations.core.documents import rows_json
from tumble.calibrations.core.gravity import PerAcceleration
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.propagation import Simulated, simulated_json
from tumble.calibrations.methods.dividing_head.flips import FlipClosure
from tumble.calibrations.methods.dividing_head.joint import Noise
from tumble.calibrations.methods.dividing_head.model import UNITS
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.published import PublishedValue
from tumble.calibrations.stand_records.record import StandRecord
from tumble.messages import Message

SCHEMA = "tumble.fit/1"


@dataclass(frozen=True, kw_only=True)
class Calibration:
    """Everything that the analysis of one table says."""

    observations: Observations
    """The rows used; what was set aside is listed in it."""
    parameters: Mapping[str, Parameter]
    correlation: FloatArray
    """Shape (6, 6), in the order of `parameters`; NaN where a parameter has no value."""
    noise: Noise
    residual_v: FloatArray
    """Measured minus fitted, shape (rows,), in volts."""
    weights: FloatArray
    """Relative weight of each row, mean 1."""
    residual_rms_v: float
    held_out_rms_v: float | None
    lack_of_fit_p: float | None
    closure: FlipClosure | None
    published: Mapping[str, PublishedValue]
    budget: tuple[BudgetLine, ...]
    monte_carlo: Mapping[str, Simulated]
    """What propagation of distributions gives, by name."""
    per_acceleration: Mapping[str, PerAcceleration]
    """Empty where local gravity is not known."""
    warnings: tuple[str, ...]
    stand_record: StandRecord | None = None
    """What the rows were corrected by."""

    def as_json(self) -> dict[str, Any]:
        """The result as `tumble.fit/1`."""
        return {
            "schema": SCHEMA,
            "rows": rows_json(self.observations),
            "complete": self.observations.complete,
            "noise": {
                "pure_error_V": self.noise.pure_error_v,
                "degrees_of_freedom": self.noise.degrees_of_freedom,
                "used_V": self.noise.used_v,
                "used_degrees_of_freedom": self.noise.used_degrees_of_freedom,
                "basis": self.noise.basis,
            },
            "parameters": {name: parameter.as_json() for name, parameter in self.parameters.items()},
            "correlation": _correlation_json(self.parameters, self.correlation),
            "residual_rms_V": self.residual_rms_v,
            "held_out_rms_V": self.held_out_rms_v,
            "lack_of_fit_p": self.lack_of_fit_p,
            "flip_closure": closure_json(self.closure),
            "published_method": {"parameters": {name: _published_json(name, v) for name, v in self.published.items()}},
            "budget": [line.as_json() for line in self.budget],
            "monte_carlo": simulated_json(self.monte_carlo),
            "per_m_s2": {name: each.as_json() for name, each in self.per_acceleration.items()},
            "warnings": list(self.warnings),
        } | ({"stand_record": self.stand_record.reference} if self.stand_record else {})


def closure_json(closure: FlipClosure | None) -> dict[str, Any]:
    """Closure of the flips as `tumble.fit/1` has it."""
    if closure is None:
        return {"p_value": None, "reason": Message("there is no complete flip")}
    result: dict[str, Any] = {
        axis: {"u0_V": mean.u0_v, "standard_uncertainty": mean.standard_uncertainty_v or None}
        for axis, mean in closure.axes.items()
    }
    result["p_value"] = closure.p_value
    if closure.worst:
        first, second, difference, sigmas = closure.worst
        result["worst"] = {"axes": [first, second], "difference_V": difference, "standard_uncertainties": sigmas}
    return result


def _published_json(name: str, value: PublishedValue) -> dict[str, Any]:
    result: dict[str, Any] = {
        "value": value.value,
        "standard_uncertainty": value.standard_uncertainty,
        "unit": UNITS[name],
    }
    return result | ({"reason": value.reason} if value.reason else {})


def _correlation_json(parameters: Mapping[str, Parameter], correlation: FloatArray) -> dict[str, dict[str, float]]:
    stated = [(i, name) for i, name in enumerate(parameters) if parameters[name].value is not None]
    return {name: {other: float(correlation[i, j]) for j, other in stated} for i, name in stated}
