"""A programme of twenty dwells that tests cut off: what it is, and what of a recording must be the same."""

import shutil
from dataclasses import replace

TWICE = """\
name = "twice"
realisations = 2
dwell_s = 0.1
settle_s = 0.0

[[procedure]]
kind = "flip"
axes = ["x", "y"]

[[procedure]]
kind = "sweep"
step_deg = 60.0
points = 6
"""
"""Twenty dwells in two mounts and two realisations."""
POINTS = 20


def measured(recording):
    """Everything of the points but their time, which is a sum of floating-point numbers."""
    return [replace(point, time_s=0.0, temperature_degc=None) for point in recording.points]


def moved(path, target):
    shutil.move(path, target)
    return target
