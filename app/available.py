"""Which experiments a stand can run: asked of the stand, not assumed."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

from tumble.app.running import Job
from tumble.app.stand import LoadedStand
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.probes import PROBES, STEP_DEG, Probe
from tumble.procedures.errors import ProgrammeError
from tumble.procedures.methods.dividing_head.sweep import Sweep
from tumble.procedures.programme import Programme, load_programme, programme_from_text

NO_THERMOMETER = "the stand has no thermometer"
NOBODY_WARMS = "nobody is at the stand who could warm the unit"


@dataclass(frozen=True, kw_only=True)
class Available:
    """Experiments that can be run, as long as this stand takes for them, and those that cannot."""

    probes: tuple[Probe, ...]
    refused: Mapping[str, tuple[Probe, str]] = field(default_factory=dict)
    """Each with the reason, by the name of its programme."""

    def without(self, gone: Callable[[Probe], bool], reason: str) -> "Available":
        """What is left once some of it cannot be run any more."""
        refused = {probe.programme: (probe, reason) for probe in self.probes if gone(probe)}
        left = tuple(probe for probe in self.probes if not gone(probe))
        return Available(probes=left, refused={**self.refused, **refused})

    def probe(self, programme: str) -> Probe:
        """The experiment of a programme."""
        return next(probe for probe in self.probes if probe.programme == programme)


def available(stand: LoadedStand, observations: Observations, attended: bool) -> Available:
    """Ask a stand which experiments it can run after a table.

    Parameters
    ----------
    stand
        Head limits, cable, seat and speed are its own.
    observations
        What was measured: without a temperature in it, the stand has no thermometer.
    attended
        Whether a person is there who can warm the unit.
    """
    asked = [_asked(stand, probe) for probe in PROBES]
    refused = {probe.programme: (probe, reason) for probe, reason in asked if reason}
    found = Available(probes=tuple(probe for probe, reason in asked if not reason), refused=refused)
    if observations.temperature_degc is None:
        return found.without(warms, NO_THERMOMETER)
    return found if attended else found.without(warms, NOBODY_WARMS)


def warms(probe: Probe) -> bool:
    """Whether an experiment needs the unit at another temperature."""
    return probe.warmer_k != 0.0


def programme_of(probe: Probe) -> Programme:
    """The programme of an experiment: the one that comes along, shortened where the experiment is."""
    shipped = load_programme(probe.programme)
    (sweep,) = shipped.parts
    assert isinstance(sweep, Sweep), "every probe is one"
    if (sweep.start_deg, sweep.points) == (probe.start_deg, probe.points):
        return shipped
    lines = [line for line in shipped.text.splitlines() if not line.startswith(("start_deg", "step_deg", "points"))]
    angles = f"start_deg = {probe.start_deg}\nstep_deg = {STEP_DEG}\npoints = {probe.points}"
    return programme_from_text("\n".join([*lines, angles, ""]), f"{probe.programme}.toml, shortened")


def _asked(stand: LoadedStand, probe: Probe) -> tuple[Probe, str]:
    """An experiment as this stand would run it, and why it will not; an empty reason where it will."""
    head = stand.file.head
    turns_deg = math.inf if head.cable_turns is None else 360.0 * head.cable_turns
    lowest_deg, highest_deg = max(head.limits_deg[0], -turns_deg), min(head.limits_deg[1], turns_deg)
    short = probe.between(lowest_deg, highest_deg)
    if short is None:
        return probe, f"the head may turn from {lowest_deg:g} to {highest_deg:g} deg, which leaves no room for it"
    job = Job(stand=stand, programme=programme_of(short), serial_number="")
    acquisition = job.acquisition
    timed = replace(
        short,
        mounting_s=head.mounting_s,
        speed_deg_s=head.speed_deg_s,
        dwell_s=acquisition.planned_settling_s + acquisition.dwell_s,
    )
    try:
        job.plan()
    except ProgrammeError as error:
        return timed, str(error)
    return timed, ""
