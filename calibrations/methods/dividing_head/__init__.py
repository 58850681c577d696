"""An accelerometer on a dividing head in the gravity field: from rows to parameters, verdict and closed loop.

- `observations`, `table`: the rows; `geometry`, `model`: how they follow from the parameters.
- `analysis.analyse`: the joint fit with its uncertainty; `judging.judge`: the verdict.
- `effects`: the catalogue; `loop.loop.close_loop`: what the model leaves, traced to effects.
"""
