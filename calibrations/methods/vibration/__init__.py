"""Vibration rectification: dwells at rest and under vibration, reduced from samples, fitted, and traced.

- `observations`: the table; `products`: whole-period mean products of the accelerations of its rows.
- `dwells`: samples of dwells reduced to rows of that table.
- `model`, `table`, `fit`: the five second-order coefficients, and what an experiment can tell of them.
- `effects`: the catalogue; `loop.close_vibration_loop` closes the loop.
"""
