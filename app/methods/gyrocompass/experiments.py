"""Which positions and leans a stand with a turntable can run: asked of the stand, not assumed."""

from dataclasses import replace
from typing import Final

import numpy as np

from tumble.app.available import Available, Offer
from tumble.app.running import Outline
from tumble.app.stand import LoadedStand
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations
from tumble.calibrations.methods.gyrocompass.probes import PROBES, GyrocompassProbe
from tumble.procedures.errors import ProgrammeError
from tumble.procedures.methods.gyrocompass.layout import BASE
from tumble.procedures.programme import Programme
from tumble.procedures.programmes import load_programme, programme_from_text, with_samples

_REPEATS: Final = "repeats = 4"
"""Of every programme that comes along."""
_PASSES: Final = 2
"""With a single pass, what a new position shows could not be told from one dwell that went wrong."""
_LEANING: Final = "\nbase = 2"


def available(stand: LoadedStand, rows: GyrocompassObservations) -> Available:
    """Ask a stand which of the programmes that come along it can run after a table, two passes of each.

    A dwell takes as many samples as those of the table. Another lean is the next number after those of the table, and
    whoever is at the stand is asked for it.
    """
    asked = [_asked(stand, _repeated(probe), rows) for probe in PROBES if probe.comes_along]
    return Available(
        offers=tuple(offer for offer, reason in asked if not reason),
        refused={offer.programme.name: (offer, reason) for offer, reason in asked if reason},
    )


def _repeated(probe: GyrocompassProbe) -> GyrocompassProbe:
    return replace(probe, azimuths_deg=probe.azimuths_deg * _PASSES)


def renewed(left: Available, rows: GyrocompassObservations) -> Available:
    """The same experiments on the base as it leans by now, and another lean as the next number."""
    return replace(left, offers=tuple(_renewed(offer, rows) for offer in left.offers))


def _renewed(offer: Offer, rows: GyrocompassObservations) -> Offer:
    probe = offer.probe
    assert isinstance(probe, GyrocompassProbe), "its own"
    now = _offer(probe, rows)
    return replace(offer, programme=now.programme, needs=now.needs)


def _asked(stand: LoadedStand, probe: GyrocompassProbe, rows: GyrocompassObservations) -> tuple[Offer, str]:
    """A programme as this stand would run it, and why it will not; an empty reason where it will."""
    offer = _offer(probe, rows)
    try:
        planned = Outline(stand=stand, programme=offer.programme).plan()
    except ProgrammeError as error:
        return offer, str(error)
    return replace(offer, probe=replace(probe, step_s=planned.duration_s / len(probe.azimuths_deg))), ""


def _offer(probe: GyrocompassProbe, rows: GyrocompassObservations) -> Offer:
    base = _base(probe, rows)
    needs = {BASE: str(base)} if probe.leans else {}
    return Offer(probe=probe, programme=_programme(probe, rows, base), needs=needs)


def _base(probe: GyrocompassProbe, rows: GyrocompassObservations) -> int | None:
    """How the base leans: in a new way, or as in the last row; None where it has never been leaned."""
    if rows.base is None or rows.base.max() == 1:
        return 2 if probe.leans else None
    return int(rows.base.max()) + 1 if probe.leans else int(rows.base[-1])


def _programme(probe: GyrocompassProbe, rows: GyrocompassObservations, base: int | None) -> Programme:
    """Two passes of the programme that comes along, on a base that leans in some way."""
    leaning = "" if base is None else f"\nbase = {base}"
    text = load_programme(probe.programme).text.replace(_LEANING, "").replace(_REPEATS, f"repeats = {_PASSES}{leaning}")
    samples = None if rows.samples is None else int(np.median(rows.samples))
    if samples is not None and samples >= 2:
        text = with_samples(text, samples)
    return programme_from_text(text, f"{probe.programme}.toml")
