"""A triad of accelerometers on a two-axis stand: the vector fit, the scalar fit, and what they leave, traced.

- `observations`: the table; `geometry`: gravity in the case, for any position of the two axes.
- `model`, `table`: the fourteen parameters, and all three channels as one table that may be traced.
- `scalar`: the nine parameters that need no stand angle.
- `effects`: the catalogue; `loop.close_triad_loop` closes the loop.
"""
