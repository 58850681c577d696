"""Samples of dwells at rest and under vibration, reduced to means, mean products and their uncertainty.

- `samples`: the table of samples; `sine`: offset, harmonics and frequency of a dwell, fitted together.
- `refusals`: what no fit mends, by name; `long_run`: uncertainty of a mean whose noise is autocorrelated.
- `reduction.reduced`: all of it on a file.
"""
