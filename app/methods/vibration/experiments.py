"""Which programmes a stand for vibration can run: asked of the stand, not assumed."""

from dataclasses import replace

from tumble.app.available import Available, Offer
from tumble.app.running import Outline
from tumble.app.stand import LoadedStand
from tumble.calibrations.methods.vibration.probes import PROBES, VibrationProbe
from tumble.procedures.errors import ProgrammeError
from tumble.procedures.programmes import load_programme


def available(stand: LoadedStand) -> Available:
    """Ask a stand which programmes it can run: what it drives, its levels and frequencies are its own."""
    asked = [_asked(stand, probe) for probe in PROBES]
    return Available(
        offers=tuple(offer for offer, reason in asked if not reason),
        refused={offer.programme.name: (offer, reason) for offer, reason in asked if reason},
    )


def _asked(stand: LoadedStand, probe: VibrationProbe) -> tuple[Offer, str]:
    """A programme as this stand would run it, and why it will not; an empty reason where it will."""
    offer = Offer(probe=probe, programme=load_programme(probe.programme))
    try:
        planned = Outline(stand=stand, programme=offer.programme).plan()
    except ProgrammeError as error:
        return offer, str(error)
    step_s = planned.duration_s * probe.step_s / probe.stand_time_s
    return replace(offer, probe=replace(probe, step_s=step_s)), ""
