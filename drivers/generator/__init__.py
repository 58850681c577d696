"""A function generator that drives shakers through their amplifiers, over SCPI (33500B and 33600A class).

- `table`: its keys in a stand file; `models`: which generators are known.
- `generator`: the driver; `settings`: what it is told and says, channel by channel; `waveform`: random vibration.
"""
