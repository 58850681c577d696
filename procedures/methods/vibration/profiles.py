"""Spectral densities that come along: points (Hz, g²/Hz)."""

from collections.abc import Mapping
from typing import Final

PROFILES: Final[Mapping[str, tuple[tuple[float, float], ...]]] = {
    "us-highway-vertical": (
        (10.0, 0.015),
        (40.0, 0.015),
        (500.0, 0.00015),
    ),
    "flat-20-500": ((20.0, 0.01), (500.0, 0.01)),
}
"""The first: common carrier on US highways, vertical axis (MIL-STD-810G and H, method 514, category 4: 1.04 g r.m.s.).
The second: 2.2 g r.m.s., even."""
