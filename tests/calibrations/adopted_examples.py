"""Runs and effects for the tests of adoption, made of a few numbers."""

from datetime import UTC, datetime

import numpy as np

from tumble.calibrations.adopted.curve import Curve
from tumble.calibrations.adopted.document import sealed
from tumble.calibrations.adopted.effect import AdoptedEffect, UnitSeen, UnitType
from tumble.calibrations.adopted.knots import Knots
from tumble.calibrations.adopted.seen import Seen
from tumble.calibrations.core.provenance import Source

PLACES = np.linspace(-1.0, 1.0, 21)
KNOTS = Knots(places=PLACES[:, None])
BUMP = np.exp(-0.5 * ((PLACES - 0.3) / 0.2) ** 2)
STEPS = np.where(PLACES > -0.4, 0.5, -0.5)
SAW = np.resize([1.0, -0.6, 0.2, -1.0, 0.5, 0.7, -0.8], 21)
"""What a run scatters by at the knots, in standard deviations."""


def run(size, clearness=10.0, course=BUMP, scatter=SAW):
    """A run that sees each knot so many standard deviations clearly for a course of 1."""
    return Seen(design=clearness * np.eye(21), output=clearness * size * course + scatter)


def effect(name="odd_bump", spread=0.2, uncertainty=0.01, values=BUMP, units=5):
    """An effect along ax, found on five units."""
    source = Source(kind="recording", path="recordings/U-1/a.mcap", sha256="0" * 64)
    seen_on = [
        UnitSeen(serial_number=f"U-{n}", size=1.0, standard_uncertainty=0.05, measured_at="", sources=(source,))
        for n in range(units)
    ]
    return sealed(
        AdoptedEffect(
            name=name,
            method="dividing_head",
            kept_with=UnitType(name="QX-1"),
            channel="offset",
            variable="acceleration",
            detail="ax",
            depends_on="acceleration",
            also_possible=(("offset", "pose"),),
            channel_unit="V",
            variable_unit="g",
            curve=Curve(knots=KNOTS, values=1e-3 * values, covariance=(1e-3 * uncertainty) ** 2 * np.eye(21)),
            kernel="smooth 0.15",
            gain=120.0,
            spread=spread,
            units=tuple(seen_on),
            operator="Оксана",
            adopted_at=datetime(2026, 11, 27, 12, 0, tzinfo=UTC),
            program_version="0.2.0",
        )
    )
