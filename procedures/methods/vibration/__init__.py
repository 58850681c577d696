"""Vibration rectification at a stand: its programmes, its columns, and the table of a recording.

- `layout`: the columns of a dwell; `procedures`: sines, random vibration, several shakers, a double centrifuge.
- `programme`: lists of these; `observations`: a recording as the table that the analysis reads, `products` its motion.
- `method`: what registers it.
"""
