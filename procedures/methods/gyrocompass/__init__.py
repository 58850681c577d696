"""A gyro platform on an azimuth turntable: its positions, its columns, and the table of a recording.

- `layout`: the columns of a dwell; `positions`: where the turntable goes, in which order, on which base.
- `programme`: positions, levelling, noise; `observations`: a recording as the table that the analysis reads.
- `method`: what registers it.
"""
