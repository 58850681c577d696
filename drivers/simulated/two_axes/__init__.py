"""The world of three accelerometers on a stand with two axes; it shares no line with any analysis.

- `settings`: its table `[simulated]`, and `effects`, what may be injected there.
- `geometry`: where gravity points in the case.
- `unit`: three channels.
- `world`: the axes and the unit on them; `meter`: a voltmeter at its outputs.
"""
