"""Small synthetic calibrations for the tests of the report, made from the geometry alone."""

import functools

import numpy as np

from tumble.calibrations.core.gravity import Gravity
from tumble.calibrations.core.provenance import Provenance, Source
from tumble.calibrations.methods.dividing_head.analysis import analyse
from tumble.calibrations.methods.dividing_head.budget import StandUncertainty
from tumble.calibrations.methods.dividing_head.geometry import projections
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.report import calibration_report
from tumble.calibrations.methods.dividing_head.report.page import PARTS
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.report.document import Report
from tumble.calibrations.report.origin import origin
from tumble.calibrations.report.page import html
from tumble.calibrations.report.written import written

SWEEP_DEG = np.arange(0.0, 400.0, 10.0)
STAND = StandUncertainty(
    head_accuracy_arcsec=5,
    seating_arcsec=10,
    daq_gain=1e-5,
    daq_offset_v=5e-6,
    gravity=Gravity(value_m_s2=9.81, standard_uncertainty_m_s2=5e-4),
)


def dwells(poses, realisations=3, noise_v=1e-4, kxy=1e-3, k_xx=0.0, **columns) -> Observations:
    """Rows at `poses`, pairs of mount and head angles, repeated; a unit with u0 2.5, kx 1, ky 0.01, kz 0.002."""
    mount = np.concatenate([np.full(len(angles), name) for name, angles in poses] * realisations)
    angle_deg = np.concatenate([np.asarray(angles, float) for _, angles in poses] * realisations)
    rows = len(angle_deg)
    ax, ay, az = projections(mount, angle_deg + 0.1).T
    noise = np.random.default_rng(7).normal(scale=noise_v, size=rows) if noise_v else 0.0
    return Observations(
        row=np.arange(1, rows + 1),
        angle_deg=angle_deg,
        voltage_v=2.5 + ax + 0.01 * ay + 0.002 * az + kxy * ax * ay + k_xx * ax**2 + noise,
        mount=mount,
        realisation=np.repeat(np.arange(1, realisations + 1), rows // realisations),
        **columns,
    )


FLIPS = (("face-up", [-90.0, 90.0, 180.0, 0.0]), ("edge", [180.0, 0.0]))
FACE_UP = (*FLIPS, ("face-up", SWEEP_DEG))
REVERSED = (*FACE_UP, ("face-down", SWEEP_DEG))


def calibrate(observations: Observations) -> Calibration:
    return analyse(observations, STAND, trials=500)


@functools.cache
def face_up() -> Calibration:
    """Flips and one face-up sweep: alpha0 is told through kxy alone."""
    return calibrate(dwells(FACE_UP))


@functools.cache
def reversed_() -> Calibration:
    """The same with a face-down sweep, which settles alpha0."""
    return calibrate(dwells(REVERSED))


@functools.cache
def flips_only() -> Calibration:
    """Flips alone, which tell neither kxy nor alpha0."""
    return calibrate(dwells(FLIPS))


def provenance(**changes) -> Provenance:
    texts = {
        "serial_number": "SN-1",
        "lot": "L-26",
        "operator": "A. Operator",
        "programme_name": "seed-2008",
        "stand": {"name": "bench-1", "head": {"limits_deg": [-180.0, 760.0], "accuracy_arcsec": 5.0}},
        "sources": (Source(kind="recording", path="runs/run-1.mcap", sha256="0123abcd"),),
        "measured_at": "2026-11-03T10:15:00+02:00",
        "program_version": "0.1.0",
        "git_commit": "8669ad0",
        "packages": {"numpy": "2.2.1"},
    }
    return Provenance(**{**texts, **changes})


def page_of(calibration, origin, **more) -> str:
    """The report as HTML."""
    return html(written(calibration_report(calibration, origin, **more)))


def chapter(anchor, subject) -> str:
    """One chapter of the page, without its heading."""
    chapters = {part.anchor: part.chapter for part in PARTS} | {"origin": lambda shown: origin(shown.provenance)}
    page = html(written(Report(kind="", title="", chapters=[chapters[anchor](subject)])))
    return page.split("</h2>\n")[1].split("</section>")[0]
