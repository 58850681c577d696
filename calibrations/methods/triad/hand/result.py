"""The scalar fit of a triad that was held still by hand, as a result."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.gross import gross_sigmas
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.quantities import format_concise, format_number
from tumble.calibrations.core.verdict import Model, Verdict
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.triad.entry import VERSION
from tumble.calibrations.methods.triad.geometry import ARCSEC_PER_RAD
from tumble.calibrations.methods.triad.hand.log import Log
from tumble.calibrations.methods.triad.hand.still import QUIETEST, SHORTEST_S, TIMES, WINDOW_S, Pose, still_poses
from tumble.calibrations.methods.triad.scalar import PARAMETERS, ScalarFit, fit_scalar
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.tracing.document import SCHEMA
from tumble.messages import Message

_SPARE = 3
"""So many poses more than parameters are asked for."""
_ROUNDS = 5
_NO_TRIAD = 0.02
"""Outputs in which gravity is longer or shorter by more than this part, in half of the poses, are no triad's."""


@dataclass(frozen=True, kw_only=True)
class HandResult:
    """What poses without any angle tell of a triad."""

    log: Log
    poses: tuple[Pose, ...]
    """Those of a log with time; none where every row is a pose."""
    outputs: FloatArray
    """Mean of each pose, shape (poses, 3)."""
    used: NDArray[np.bool_]
    """Which poses are no gross errors, shape (poses,)."""
    fit: ScalarFit

    @property
    def warnings(self) -> tuple[str, ...]:
        """What was odd in the file."""
        return self.log.rows.warnings

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """The nine of the scalar fit, in the unit of the log."""
        unit = self.log.unit
        return {name: replace(each, unit=each.unit.replace("V", unit)) for name, each in self.fit.parameters.items()}

    @property
    def noise_arcsec(self) -> float | None:
        """Mismatch that the noise of the means explains, r.m.s.; None where rows are poses."""
        if not self.poses:
            return None
        inverse = np.linalg.inv(self.fit.lower_v)
        means = self.outputs[self.used]
        a = (means - self.fit.bias_v) @ inverse.T
        back = (a / np.linalg.norm(a, axis=1, keepdims=True)) @ inverse
        spread = np.array([pose.mean_deviation for pose in self.poses])[self.used]
        return float(np.sqrt(np.mean(np.sum((back * spread) ** 2, axis=1))) * ARCSEC_PER_RAD)

    def document(self) -> dict[str, Any]:
        """The result as `tumble.loop/1`, kind `scalar`."""
        mismatch = self.fit.mismatch
        return {
            "schema": SCHEMA,
            "method": "triad",
            "kind": "scalar",
            "rows": {
                "read": self.log.rows.rows_read,
                "used": len(self.log.rows),
                "set_aside": [{"row": each.row, "reason": each.reason} for each in self.log.rows.set_aside],
            },
            "poses": {"found": len(self.outputs), "used": int(self.used.sum())},
            "warnings": list(self.warnings),
            "scalar": {"parameters": {name: each.as_json() for name, each in self.parameters.items()}},
            "mismatch_arcsec": {
                "mean": mismatch.mean_arcsec,
                "sd": mismatch.standard_deviation_arcsec,
                "max": mismatch.largest_arcsec,
                "degrees_of_freedom": mismatch.degrees_of_freedom,
                "noise": self.noise_arcsec,
            },
            "effects": [],
            "unexplained": None,
        }

    def entry(self) -> Entry:
        """The result as the store takes it."""
        document = self.document()
        return Entry(
            method="triad",
            method_version=VERSION,
            result=document,
            parameters=document["scalar"]["parameters"],
            verdict=Verdict(judged=Model.DECLARED, parameters=()),
        )

    def sections(self) -> Sequence[Section]:
        """What is shown."""
        return [*_sections(self)]


def _sections(result: HandResult) -> Iterator[Section]:
    yield Section(
        title=Message("Scalar fit"),
        headings=(Message("Parameter"), Message("Value")),
        rows=[(name, _value(each)) for name, each in result.parameters.items()],
        brief=True,
    )
    yield Section(title=Message("What is left"), lines=[*_left(result)], brief=True)
    if result.poses:
        criterion = Message(
            "A sample is still where the window of {window:g} s round it scatters by less than {times:g} times what "
            "the quietest {quietest:.0%} of all windows do; intervals of at least {shortest:g} s are used.",
            window=WINDOW_S,
            times=TIMES,
            quietest=QUIETEST,
            shortest=SHORTEST_S,
        )
        yield Section(
            title=Message("Still intervals"),
            lines=(criterion,),
            headings=(Message("Start (s)"), Message("Length (s)"), "x", "y", "z"),
            rows=[
                (f"{pose.start_s:.1f}", f"{pose.length_s:.1f}", *(f"{value:.7g}" for value in pose.mean))
                for pose in result.poses
            ],
        )


def _value(parameter: Parameter) -> str:
    if parameter.value is None or parameter.standard_uncertainty is None:
        return Message("not identifiable: {reason}", reason=parameter.reason)
    return format_concise(parameter.value, parameter.standard_uncertainty, parameter.unit)


def _left(result: HandResult) -> Iterator[str]:
    mismatch = result.fit.mismatch
    deviation = mismatch.standard_deviation_arcsec
    yield Message(
        "Mismatch |a| - 1 (poses: {poses}): standard deviation {deviation}, degrees of freedom {freedom}, largest "
        "{largest}.",
        poses=int(result.used.sum()),
        deviation="—" if deviation is None else format_number(deviation, "″"),
        freedom=mismatch.degrees_of_freedom,
        largest=format_number(mismatch.largest_arcsec, "″"),
    )
    noise = result.noise_arcsec
    if noise is not None and deviation is not None:
        yield Message(
            "The noise of the means explains {noise} of it. The rest is what nine parameters leave: nonlinearity, "
            "temperature, or a pose that was not quite still. Without angles it cannot be traced further.",
            noise=format_number(noise, "″"),
        )
    yield Message(
        "Nothing here tells how the axes stand in the case: a rotation of the whole triad leaves every length as it "
        "is. That takes a stand with known angles."
    )


def calibrated_by_hand(log: Log) -> HandResult:
    """Fit the nine scalar parameters to a log. Raises `ValueError` where there are too few poses."""
    poses = () if log.time_s is None else still_poses(log.time_s, log.outputs)
    outputs = log.outputs if log.time_s is None else np.array([pose.mean for pose in poses]).reshape(-1, 3)
    least = PARAMETERS + _SPARE
    if len(outputs) < least:
        raise ValueError(
            Message.counted(
                "{source}: {count} still pose is too few for nine parameters; hold the unit still for some seconds "
                "in at least {least} poses all round",
                "{source}: {count} still poses are too few for nine parameters; hold the unit still for some "
                "seconds in at least {least} poses all round",
                source=log.rows.source,
                count=len(outputs),
                least=least,
            )
        )
    variances = np.ones(3) if not poses else np.mean([pose.mean_deviation**2 for pose in poses], axis=0)
    used = np.ones(len(outputs), dtype=bool)
    for _ in range(_ROUNDS):
        fit = fit_scalar(outputs[used], variances)
        if fit is None or np.median(np.abs(fit.mismatch.each_arcsec)) > _NO_TRIAD * ARCSEC_PER_RAD:
            break
        bad = _gross(fit.mismatch.each_arcsec)
        if not bad.any() or used.sum() - bad.sum() < least:
            return HandResult(log=log, poses=poses, outputs=outputs, used=used, fit=fit)
        used[np.flatnonzero(used)[bad]] = False
    raise ValueError(
        Message(
            "{source}: no nine parameters make gravity as long in every pose; are the three outputs of one triad, and "
            "was it held still all round?",
            source=log.rows.source,
        )
    )


def _gross(mismatch: FloatArray) -> NDArray[np.bool_]:
    """Poses whose mismatch is far beyond that of the others."""
    centred = np.abs(mismatch - np.median(mismatch))
    scale = max(float(1.4826 * np.median(centred)), 1e-12)
    return np.asarray(centred > gross_sigmas(len(mismatch) - PARAMETERS) * scale)
