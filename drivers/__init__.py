"""Instruments: dividing head and DAQ behind narrow protocols, and the simulated stand.

- `protocols`: what the engine sees of a stand.
- `clock`: time as an object.
- `errors`: what can go wrong at an instrument.
- `simulated`: a stand with physics of its own.
"""
