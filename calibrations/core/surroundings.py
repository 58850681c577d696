"""What the surroundings will be like in an hour, from what they were: they go on along their line, and wander off it.

The wandering is taken for a random walk, of the size that leaves as much beside a straight line as the table has there:
that is sigma² T / 15 in the mean square for rows evenly spread over a time T. A walk knows no limits, and a room has
some: what is said of many hours ahead is too much rather than too little.
"""

from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray

_NODES: Final = 60
"""The table, and what comes after it, are taken in so many pieces at most."""
_TYPICAL: Final = 0.6745
"""Half of all that is normal is within so many standard deviations."""
_NOTHING: Final = 1e-6
"""Of a walk, less than this part of the time is none."""
_EXACT: Final = 1e-12
"""Variance of a piece whose readings show no noise at all, in squares of their unit: the covariance is inverted."""
_COURSES: Final = 25
"""So many are drawn; an odd number has a median."""


def typical_course(then_s: FloatArray, values: FloatArray, later_s: FloatArray) -> FloatArray:
    """Return a course that is as likely to depart more from what was as less, shape of `later_s`.

    It is the median, by the distance of everything from one line, of courses that are drawn from what a line and a
    random walk predict (universal kriging, Rasmussen and Williams 2006, chapter 2.7). The same values give the same
    course.

    Parameters
    ----------
    then_s, values
        What was measured, in any order; at least three rows, not all at one time.
    later_s
        When it will be measured again, in the order of time.
    """
    order = np.argsort(then_s, kind="stable")
    then_s, values = then_s[order], values[order]
    at_s, seen = _pieces(then_s, values)
    nodes_s = np.linspace(later_s[0], later_s[-1], min(_NODES, len(later_s)))
    noise = max(_noise(values) * len(at_s) / len(values), _rounding(values))
    courses = _drawn(at_s - at_s[0], seen, noise, nodes_s - at_s[0])
    whole_s = np.concatenate([at_s, nodes_s])
    far = [float(np.mean(_off(whole_s, np.concatenate([seen, course])) ** 2)) for course in courses]
    return np.asarray(np.interp(later_s, nodes_s, courses[int(np.argsort(far)[_COURSES // 2])]))


def _pieces(then_s: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Means of about as many rows each."""
    parts = np.array_split(np.arange(len(values)), min(_NODES, len(values)))
    return np.array([then_s[part].mean() for part in parts]), np.array([values[part].mean() for part in parts])


def _noise(values: FloatArray) -> float:
    """Variance of one reading, from neighbours; the few that are far apart in time do not count."""
    steps = np.diff(values)
    return float(np.median(np.abs(steps - np.median(steps))) / (_TYPICAL * 2.0**0.5)) ** 2


def _rounding(values: FloatArray) -> float:
    """Variance of readings that mostly repeat, rounded to the smallest step seen; means of them are no better."""
    steps = np.abs(np.diff(values))
    repeated = np.median(steps) == 0.0 < steps.max()
    return float(np.min(steps[steps > 0.0])) ** 2 / 12.0 if repeated else 0.0


def _line(time_s: FloatArray, whole_s: float) -> FloatArray:
    return np.column_stack([np.ones(len(time_s)), time_s / whole_s])


def _off(time_s: FloatArray, values: FloatArray) -> FloatArray:
    """What a line leaves of each column."""
    line = _line(time_s - time_s[0], float(np.ptp(time_s)))
    return np.asarray(values - line @ np.linalg.lstsq(line, values, rcond=None)[0])


def _walk_per_s(at_s: FloatArray, seen: FloatArray, noise: float) -> float:
    """Variance that the walk gains in a second; `at_s` begins with the table."""
    left_s = float(np.trace(_off(at_s, _off(at_s, np.minimum.outer(at_s, at_s)).T))) / len(at_s)
    if left_s < _NOTHING * at_s[-1]:
        return 0.0  # rows at two times only: a line is all that they show
    return max(float(np.mean(_off(at_s, seen) ** 2)) - noise, 0.0) / left_s


def _drawn(at_s: FloatArray, seen: FloatArray, noise: float, nodes_s: FloatArray) -> FloatArray:
    """Courses that a line and a walk predict from what was seen, shape (courses, nodes); time begins with the table."""
    walk_per_s = _walk_per_s(at_s, seen, noise)
    known = walk_per_s * np.minimum.outer(at_s, at_s) + max(noise, _EXACT) * np.eye(len(at_s))
    across = walk_per_s * np.minimum.outer(nodes_s, at_s)
    line, further = (_line(each, at_s[-1]) for each in (at_s, nodes_s))
    weighted = np.linalg.solve(known, line)
    unsure = np.linalg.inv(line.T @ weighted)
    fitted = unsure @ weighted.T @ seen
    gain = np.linalg.solve(known, across.T).T
    rest = further - gain @ line
    spread = walk_per_s * np.minimum.outer(nodes_s, nodes_s) - gain @ across.T + rest @ unsure @ rest.T
    values, turned = np.linalg.eigh(spread)
    chance = np.random.default_rng(0).standard_normal((_COURSES, len(nodes_s)))
    return np.asarray(further @ fitted + gain @ (seen - line @ fitted) + chance * np.sqrt(values.clip(0.0)) @ turned.T)
