"""Gyrocompassing on an azimuth turntable: heading and drift, and what they leave, traced.

- `observations`: the table; `lean`: how the base leans, by the tilts; `geometry`: earth rate in pickoff angles.
- `model`, `table`: heading and drift, and rates and tilts as one table that may be traced.
- `effects`: the catalogue; `loop.close_gyrocompass_loop` closes the loop.
"""
