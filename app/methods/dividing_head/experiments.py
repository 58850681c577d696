"""Which probes a dividing head can run: asked of the stand, not assumed."""

import math
from dataclasses import replace

from tumble.app.available import Available, Offer
from tumble.app.running import Outline
from tumble.app.stand import LoadedStand
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.probes import PROBES, Probe
from tumble.messages import Message, translatable
from tumble.procedures.errors import ProgrammeError
from tumble.procedures.methods.dividing_head.layout import MOUNT
from tumble.procedures.methods.dividing_head.sweep import Sweep
from tumble.procedures.programme import Programme
from tumble.procedures.programmes import load_programme, programme_from_text
from tumble.procedures.steps import Ask

NO_THERMOMETER = Message("the stand has no thermometer")
NOBODY_WARMS = Message("nobody is at the stand who could warm the unit")
_TEMPERATURE = "temperature"
_WARM = "warm"
_WARM_PROMPT = translatable(
    "Bring the unit to a temperature about {kelvin:g} K higher than before and let it "
    "settle there; answer yes when it has, "
    "or no if that cannot be done."
)


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
    refused = {offer.programme.name: (offer, reason) for offer, reason in asked if reason}
    found = Available(offers=tuple(offer for offer, reason in asked if not reason), refused=refused)
    if observations.temperature_degc is None:
        return found.without(_warms, NO_THERMOMETER)
    return found if attended else found.without(_warms, NOBODY_WARMS)


def offered(probe: Probe) -> Offer:
    """A probe as it is run."""
    return Offer(
        probe=probe,
        programme=programme_of(probe),
        needs={MOUNT: probe.mount} | ({_TEMPERATURE: _WARM} if probe.warmer_k else {}),
        preparation=_warming(probe.warmer_k) if probe.warmer_k else None,
        wait_s=probe.wait_s,
    )


def programme_of(probe: Probe) -> Programme:
    """The programme of an experiment: the one that comes along, shortened where the experiment is."""
    shipped = load_programme(probe.programme)
    (sweep,) = shipped.parts
    assert isinstance(sweep, Sweep), "every probe is one"
    if (sweep.start_deg, sweep.points) == (probe.start_deg, probe.points):
        return shipped
    lines = [line for line in shipped.text.splitlines() if not line.startswith(("start_deg", "step_deg", "points"))]
    angles = f"start_deg = {probe.start_deg}\nstep_deg = {probe.step_deg}\npoints = {probe.points}"
    return programme_from_text(
        "\n".join([*lines, angles, ""]), Message("{programme}.toml, shortened", programme=probe.programme)
    )


def _warms(offer: Offer) -> bool:
    return _TEMPERATURE in offer.needs


def _warming(warmer_k: float) -> Ask:
    return Ask(
        condition=_TEMPERATURE,
        value=_WARM,
        task=Message("warm the unit"),
        remedy=Message("warm it"),
        prompt=Message.marked(_WARM_PROMPT, kelvin=warmer_k),
        hint=Message("Type yes when the unit has settled, or no if it cannot be warmed."),
    )


def _asked(stand: LoadedStand, probe: Probe) -> tuple[Offer, str]:
    """An experiment as this stand would run it, and why it will not; an empty reason where it will."""
    head = stand.file.head
    turns_deg = math.inf if head.cable_turns is None else 360.0 * head.cable_turns
    lowest_deg, highest_deg = max(head.limits_deg[0], -turns_deg), min(head.limits_deg[1], turns_deg)
    short = probe.between(lowest_deg, highest_deg)
    if short is None:
        room = Message(
            "the head may turn from {lowest_deg:g} to {highest_deg:g} deg, which leaves no room for it",
            lowest_deg=lowest_deg,
            highest_deg=highest_deg,
        )
        return offered(probe), room
    outline = Outline(stand=stand, programme=programme_of(short))
    acquisition = outline.acquisition
    timed = replace(
        short,
        mounting_s=head.mounting_s,
        speed_deg_s=head.speed_deg_s,
        dwell_s=acquisition.planned_settling_s + acquisition.dwell_s,
    )
    try:
        outline.plan()
    except ProgrammeError as error:
        return offered(timed), str(error)
    return offered(timed), ""
