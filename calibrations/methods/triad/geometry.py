"""Gravity in the case of a unit on a two-axis stand.

Ground frame: X along the level outer axis, Z up; at outer = inner = 0 the case stands like it, z along the inner axis.
Turns are right-handed. With the outer angle A, the inner angle B and the levels λx (tilt about the outer axis, its zero
included) and λy (positive: the X end of the outer axis is low), gravity as the case feels it is

    a = Rz(B)ᵀ Rx(A + λx)ᵀ Ry(λy)ᵀ (0, 0, -1),

in units of the local gravity, +1 where an axis points down; (-sin A sin B, -sin A cos B, -cos A) for a level stand. It
is an exact combination of three vectors that depend on the position alone: see `directions`.
"""

from dataclasses import dataclass

import numpy as np

from tumble.calibrations.core.arrays import FloatArray

ARCSEC_PER_RAD = 180.0 * 3600.0 / np.pi


@dataclass(frozen=True, kw_only=True)
class Directions:
    """Three vectors in the case for each position, each of shape (rows, 3)."""

    level: FloatArray
    """Gravity on a level stand."""
    outer: FloatArray
    """Its change with a turn of the outer axis, per radian."""
    along: FloatArray
    """The outer axis: its change with the level λy, per radian."""

    def gravity(self, level_x_rad: float, level_y_rad: float) -> FloatArray:
        """Gravity with the levels of the stand, shape (rows, 3), exactly."""
        cosine, sine = np.cos(level_y_rad), np.sin(level_y_rad)
        return np.asarray(
            cosine * (np.cos(level_x_rad) * self.level + np.sin(level_x_rad) * self.outer) + sine * self.along
        )


def directions(outer_deg: FloatArray, inner_deg: FloatArray) -> Directions:
    """The three vectors for positions, angles in degrees."""
    a, b = np.deg2rad(outer_deg), np.deg2rad(inner_deg)
    sin_a, cos_a, sin_b, cos_b = np.sin(a), np.cos(a), np.sin(b), np.cos(b)
    nothing = np.zeros_like(a)
    return Directions(
        level=np.column_stack([-sin_a * sin_b, -sin_a * cos_b, -cos_a]),
        outer=np.column_stack([-cos_a * sin_b, -cos_a * cos_b, sin_a]),
        along=np.column_stack([cos_b, -sin_b, nothing]),
    )


def inner_change(gravity: FloatArray) -> FloatArray:
    """Change of gravity in the case with a turn of the inner axis, per radian, shape (rows, 3)."""
    return np.column_stack([gravity[:, 1], -gravity[:, 0], np.zeros(len(gravity))])


def square_change(outer_deg: FloatArray, inner_deg: FloatArray) -> FloatArray:
    """Change of gravity with the angle by which the axes are not square, per radian, shape (rows, 3)."""
    a, b = np.deg2rad(outer_deg), np.deg2rad(inner_deg)
    return np.column_stack([np.cos(a) * np.cos(b), -np.cos(a) * np.sin(b), np.zeros_like(a)])


def wobble_changes(outer_deg: FloatArray, inner_deg: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Change of gravity where the inner axis is turned by w (cos(2B + p), sin(2B + p), 0) in the frame of the arm.

    Returns the changes for w cos p = 1 rad and for w sin p = 1 rad, each of shape (rows, 3).
    """
    a, b = np.deg2rad(outer_deg), np.deg2rad(inner_deg)
    nothing = np.zeros_like(a)
    in_arm = np.column_stack([nothing, -np.sin(a), -np.cos(a)])
    cosine, sine = np.cos(2 * b), np.sin(2 * b)
    turns = (np.column_stack([cosine, sine, nothing]), np.column_stack([-sine, cosine, nothing]))
    first, second = (_into_case(-np.cross(turn, in_arm), b) for turn in turns)
    return first, second


def _into_case(in_arm: FloatArray, inner_rad: FloatArray) -> FloatArray:
    """Vectors of the arm's frame in that of the case, shape (rows, 3)."""
    cosine, sine = np.cos(inner_rad), np.sin(inner_rad)
    x, y, z = in_arm.T
    return np.column_stack([cosine * x + sine * y, -sine * x + cosine * y, z])
