"""Stand records for the tests."""

from dataclasses import replace
from datetime import UTC, datetime

import numpy as np
from stand_examples import eccentric_run

from tumble.calibrations.stand_records.agreement import agreement
from tumble.calibrations.stand_records.corrections import Corrections
from tumble.calibrations.stand_records.record import Contribution, StandIdentity, StandRecord, Status, Validity
from tumble.calibrations.stand_records.terms import harmonic_term

IDENTITY = StandIdentity(stand="bench-1", head="zaber H-1", daq="scpi D-1")
UNIT = Contribution(
    serial_number="SN 1",
    raw_paths=("runs/raw.csv",),
    raw_sha256=("ab" * 32,),
    measured_at="2026-11-20T10:00:00+00:00",
    stand={"name": "bench-1"},
    coefficients=(0.05, 0.0),
    standard_uncertainties=(1e-3, 1e-3),
)
VALID = Validity(angle_deg=(0.0, 345.0), voltage_v=(1.4, 3.6), temperature_degc=(22.0, 24.0))
FOUND = Corrections(terms=(harmonic_term(1),), values=np.array([0.05, 0.0]), covariance=np.eye(2) * 1e-6)


def record_of(corrections, **changed):
    given = {
        "id": "20261124-100000-1a2b3c",
        "version": 3,
        "identity": IDENTITY,
        "status": Status.IN_FORCE,
        "corrections": corrections,
        "contributions": (UNIT, replace(UNIT, serial_number="SN 2")),
        "agreement_p": 0.41,
        "validity": VALID,
        "created_at": datetime(2026, 11, 24, 10, tzinfo=UTC),
        "program_version": "0.1.0",
    }
    return StandRecord(**{**given, **changed})


def learned():
    """What two units on one stand agree on."""
    return record_of(agreement(eccentric_run(), eccentric_run(2, True)).corrections)
