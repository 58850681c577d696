"""Which lists of positions a stand with two axes can run: asked of the stand, not assumed."""

from dataclasses import replace

import numpy as np

from tumble.app.available import Available, Offer
from tumble.app.running import Outline
from tumble.app.stand import LoadedStand
from tumble.calibrations.methods.triad.observations import TriadObservations
from tumble.calibrations.methods.triad.probes import PROBES, TriadProbe
from tumble.procedures.errors import ProgrammeError
from tumble.procedures.programme import Programme
from tumble.procedures.programmes import load_programme, programme_from_text, with_samples


def available(stand: LoadedStand, rows: TriadObservations) -> Available:
    """Ask a stand which lists it can run after a table: limits and cables of both axes are its own.

    A dwell takes as many samples as those of the table, so that its outputs weigh as much.
    """
    asked = [_asked(stand, probe, _usual_samples(rows)) for probe in PROBES]
    return Available(
        offers=tuple(offer for offer, reason in asked if not reason),
        refused={offer.programme.name: (offer, reason) for offer, reason in asked if reason},
    )


def _usual_samples(rows: TriadObservations) -> int | None:
    """Samples of a dwell of a table; None where it does not say."""
    return None if rows.samples is None else int(np.median(rows.samples))


def _asked(stand: LoadedStand, probe: TriadProbe, samples: int | None) -> tuple[Offer, str]:
    """A list as this stand would run it, and why it will not; an empty reason where it will."""
    programme = _programme(probe, samples)
    try:
        planned = Outline(stand=stand, programme=programme).plan()
    except ProgrammeError as error:
        return Offer(probe=probe, programme=programme), str(error)
    timed = replace(probe, step_s=planned.duration_s / len(probe.positions))
    return Offer(probe=timed, programme=programme), ""


def _programme(probe: TriadProbe, samples: int | None) -> Programme:
    shipped = load_programme(probe.programme)
    if samples is None or samples < 2:
        return shipped
    return programme_from_text(with_samples(shipped.text, samples), f"{probe.programme}.toml")
