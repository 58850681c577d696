"""A closed loop on a gyrocompass, as the store takes it."""

VERSION = 1
