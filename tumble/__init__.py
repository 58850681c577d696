"""Calibrates inertial sensors on a test stand, and traces what the model leaves unexplained.

- `calibrations`: the analysis; `procedures`: programmes, the engine and recordings; `drivers`: instruments.
- `emulators`: the protocols of real instruments before a simulated world.
- `app`: stand files, wiring and the command line; `window`: the operator's window.
"""
