"""What a long still recording says of the noise of each output, and of how long to average."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

from tumble.calibrations.allan.averaging import BestTime, best_time, enough_s
from tumble.calibrations.allan.coefficients import Coefficient, NoiseModel, noise_model
from tumble.calibrations.allan.deviations import Deviation, deviations
from tumble.calibrations.allan.recording import StillRecording
from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.sentences import series
from tumble.messages import Message

SCHEMA: Final = "tumble.allan/1"
_UNLIKELY: Final = 0.001


@dataclass(frozen=True, kw_only=True)
class OutputNoise:
    """The noise of one output."""

    unit: str
    deviations: tuple[Deviation, ...]
    model: NoiseModel
    best: BestTime

    @property
    def unit_of(self) -> Mapping[str, str]:
        """Units of the coefficients, by name."""
        return {"N": f"{self.unit}·√s", "B": self.unit, "K": f"{self.unit}/√s"}


@dataclass(frozen=True, kw_only=True)
class AllanResult:
    """The noise of all outputs of a recording."""

    recording: StillRecording
    outputs: Mapping[str, OutputNoise]
    """By the names of the columns."""

    @property
    def mean_best_s(self) -> float:
        """Mean of the averaging times at which the outputs have their least deviations."""
        return sum(each.best.tau_s for each in self.outputs.values()) / len(self.outputs)

    @property
    def dwell_s(self) -> float | None:
        """As long as a dwell should last: the shortest time within a tenth of the best for all outputs."""
        longest_s = min(each.best.longest_s for each in self.outputs.values())
        return enough_s([each.model for each in self.outputs.values()], longest_s)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What was odd in the recording, and where the three kinds of noise do not describe it."""
        odd = [name for name, each in self.outputs.items() if each.model.p_value < _UNLIKELY]
        if not odd:
            return self.recording.warnings
        told = Message(
            "white noise, flicker and random walk do not describe {names}: look for a trend, a period or a jump in "
            "the recording",
            names=series(odd),
        )
        return (*self.recording.warnings, told)

    def document(self) -> dict[str, Any]:
        """The result as `tumble.allan/1`."""
        return {
            "schema": SCHEMA,
            "samples": self.recording.samples,
            "rate_hz": self.recording.rate_hz,
            "warnings": list(self.warnings),
            "dwell_s": self.dwell_s,
            "mean_best_tau_s": self.mean_best_s,
            "outputs": {name: _output_json(each) for name, each in self.outputs.items()},
        }


def allan(recording: StillRecording) -> AllanResult:
    """The Allan deviation of each output of a recording, and what follows from it."""
    return AllanResult(
        recording=recording,
        outputs={name: _output(name, values, recording.rate_hz) for name, values in recording.outputs.items()},
    )


def _output(name: str, values: FloatArray, rate_hz: float) -> OutputNoise:
    found = deviations(values, rate_hz)
    model = noise_model(found, len(values), rate_hz)
    return OutputNoise(
        unit=name.rpartition("_")[2], deviations=found, model=model, best=best_time(values, rate_hz, model)
    )


def _output_json(output: OutputNoise) -> dict[str, Any]:
    return {
        "unit": output.unit,
        "coefficients": {each.name: _coefficient_json(each, output.unit_of) for each in output.model.coefficients},
        "p_value": output.model.p_value,
        "best": {
            "tau_s": output.best.tau_s,
            "interval_s": [output.best.low_s, output.best.high_s if output.best.ends else None],
            "deviation": output.best.deviation,
        },
        "deviations": [
            {"tau_s": each.tau_s, "deviation": each.value, "interval": [each.low, each.high], "alpha": each.alpha}
            for each in output.deviations
        ],
    }


def _coefficient_json(coefficient: Coefficient, units: Mapping[str, str]) -> dict[str, Any]:
    return {
        "value": coefficient.value,
        "standard_uncertainty": coefficient.standard_uncertainty,
        "at_most": coefficient.at_most,
        "unit": units[coefficient.name],
    }
