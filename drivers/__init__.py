"""Instruments: dividing head and DAQ behind narrow protocols, and the simulated stand.

- `protocols`: what the engine sees of a stand.
- `driver`: how a driver declares itself to stand files; `tables`: the keys that it builds on.
- `clock`: time as an object.
- `errors`: what can go wrong at an instrument.
- `simulated`: a stand with physics of its own.
"""
