"""Tables of a triad made by rotation matrices, for tests of its analysis."""

import csv

import numpy as np
from scipy.spatial.transform import Rotation

from tumble.calibrations.methods.triad.observations import read_triad_table
from tumble.calibrations.methods.triad.programmes import POSITIONS

ARCSEC = np.pi / 180.0 / 3600.0
NOISE_V = np.array([1.6e-5, 1.0e-5, 2.5e-5])
TRUTH = {
    "bias_x": 3e-3, "bias_y": -2e-3, "bias_z": 1e-3,
    "scale_x": 1.02, "scale_y": 0.98, "scale_z": 1.01,
    "m_xy": 120.0, "m_xz": -300.0, "m_yx": -80.0, "m_yz": 250.0, "m_zx": 40.0, "m_zy": -60.0,
    "level_x": 35.0, "level_y": -20.0,
}  # fmt: skip


def gravity(outer_deg, inner_deg, level_x=0.0, level_y=0.0):
    """Gravity in the case, levels in arc seconds, by Ry(λy) Rx(A + λx) Rz(B)."""
    base = Rotation.from_euler("y", ARCSEC * level_y)
    outer = Rotation.from_euler("x", (np.deg2rad(outer_deg) + ARCSEC * level_x)[:, None])
    inner = Rotation.from_euler("z", np.deg2rad(inner_deg)[:, None])
    return (base * outer * inner).inv().apply([0.0, 0.0, -1.0])


def made(programme="24", passes=1, *, seed=1, noise_v=NOISE_V, added=None):
    """Columns of a table; `added` is a function of gravity and positions to volts, shape (dwells, 3)."""
    outer_deg, inner_deg = np.array(POSITIONS[programme] * passes).T
    g = gravity(outer_deg, inner_deg, TRUTH["level_x"], TRUTH["level_y"])
    m = np.array([[0.0, TRUTH["m_xy"], TRUTH["m_xz"]], [TRUTH["m_yx"], 0.0, TRUTH["m_yz"]],
                  [TRUTH["m_zx"], TRUTH["m_zy"], 0.0]])  # fmt: skip
    scale = np.array([TRUTH["scale_x"], TRUTH["scale_y"], TRUTH["scale_z"]])
    bias_v = np.array([TRUTH["bias_x"], TRUTH["bias_y"], TRUTH["bias_z"]])
    u = bias_v + g @ (scale[:, None] * (np.eye(3) + ARCSEC * m)).T
    u = u + (0.0 if added is None else added(g, outer_deg, inner_deg))
    u = u + np.random.default_rng(seed).normal(0.0, 1.0, u.shape) * noise_v
    count = len(u)
    return {
        "outer_deg": outer_deg,
        "inner_deg": inner_deg,
        "u_x_V": u[:, 0],
        "u_y_V": u[:, 1],
        "u_z_V": u[:, 2],
        "time_s": 175.0 * np.arange(1, count + 1),
        "realisation": np.repeat(np.arange(1, passes + 1), count // passes),
        "sd_x_V": np.full(count, 10 * NOISE_V[0]),
        "sd_y_V": np.full(count, 10 * NOISE_V[1]),
        "sd_z_V": np.full(count, 10 * NOISE_V[2]),
        "samples": np.full(count, 100),
    }


def written(path, columns):
    """The columns as a CSV file; its path."""
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows(zip(*(values.tolist() for values in columns.values()), strict=True))
    return path


def read(tmp_path, columns):
    """The columns as the analysis reads them."""
    return read_triad_table(written(tmp_path / "triad.csv", columns))
