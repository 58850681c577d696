"""Emulated instruments: the simulated world behind the wire protocols of real devices.

- `world`: one simulated world, shared by head and DAQ.
- `speed`: a clock faster than real time.
- `faults`, `stand_faults`: what goes wrong at an instrument and at a whole stand, and when.
- `serving`: loopback TCP and pseudo-terminals.
- `zaber`: a rotary stage that speaks Zaber ASCII.
"""
