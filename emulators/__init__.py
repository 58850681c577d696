"""Emulated instruments: the simulated world behind the wire protocols of real devices.

- `world`: one simulated world, shared by head and DAQ.
- `speed`: a clock faster than real time.
- `faults`: what goes wrong, and when.
- `serving`: loopback TCP and pseudo-terminals.
- `zaber`: a rotary stage that speaks Zaber ASCII.
"""
