"""Parameters against temperature: one run of calibration at each of several temperatures, traced as any other table is.

- `table`: the table of runs; `scene`, `effects`: polynomials, breaks, steps, the order of the runs.
- `loop.close_temperature_loop`: every parameter by itself, then what several of them share.
"""
