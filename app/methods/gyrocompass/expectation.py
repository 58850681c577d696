"""How uncertain the heading of a plan will be, for the noise that its programme states."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from tumble.app.stand import WrittenStand
from tumble.calibrations.core.quantities import format_number
from tumble.calibrations.methods.gyrocompass.expected import DriftNoise, ExpectedHeading, expected_heading
from tumble.messages import Message
from tumble.procedures.methods.gyrocompass.layout import AZIMUTH
from tumble.procedures.methods.gyrocompass.programme import GyrocompassProgramme
from tumble.procedures.plan import Plan
from tumble.procedures.steps import Dwell


@dataclass(frozen=True, kw_only=True)
class Expectation:
    """What a plan promises. Fits `tumble.app.job_part.Promise`."""

    minutes: float
    heading: ExpectedHeading | None

    @property
    def sentences(self) -> tuple[str, ...]:
        """For the terminal."""
        if self.heading is None:
            return (Message("The heading is not told by these positions."),)
        return (
            Message(
                "In {minutes:.1f} min the heading is told to {rms} (standard uncertainty, r.m.s. over all headings; "
                "{worst} at worst, α0 = {alpha0:.0f}° or opposite), if the gyro is as the programme says.",
                minutes=self.minutes,
                rms=format_number(self.heading.rms_deg, "°", 2),
                worst=format_number(self.heading.worst_deg, "°", 2),
                alpha0=self.heading.worst_alpha0_deg,
            ),
        )

    def as_json(self) -> dict[str, Any]:
        """The same as JSON."""
        heading = self.heading
        told = {"rms_deg": heading.rms_deg, "worst_deg": heading.worst_deg} if heading else None
        return {"expected_heading": told}


def expectation(planned: Plan, stand: WrittenStand) -> Expectation | None:
    """What a plan promises at a stand; None where its programme does not say how the gyro wanders."""
    programme, latitude_deg = planned.programme, stand.file.site.latitude_deg
    assert isinstance(programme, GyrocompassProgramme), "its own"
    if programme.noise is None or latitude_deg is None:
        return None
    sampler = stand.file.sampling
    dwell_s = programme.acquisition(samples=sampler.samples, rate_hz=sampler.rate_hz).dwell_s
    dwells = list(_dwells(planned, dwell_s))
    heading = expected_heading(
        [azimuth_deg for azimuth_deg, _ in dwells],
        [start_s for _, start_s in dwells],
        dwell_s,
        latitude_deg,
        DriftNoise(**programme.noise.model_dump()),
    )
    return Expectation(minutes=planned.duration_s / 60.0, heading=heading)


def _dwells(planned: Plan, dwell_s: float) -> Iterator[tuple[float, float]]:
    """Angle of every dwell, and when it begins, in seconds since the run begins."""
    now_s = 0.0
    for each in planned.steps:
        now_s += each.duration_s
        if isinstance(each.step, Dwell):
            yield each.step.targets_deg[AZIMUTH], now_s - dwell_s
