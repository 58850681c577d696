"""The world of an accelerometer that is shaken; it shares no line with any analysis.

- `settings`: its table `[simulated]`, and `effects`, what may be injected there.
- `motion`: what shaker, shakers or centrifuge do; `unit`: the output as a function of that.
- `heating`: what the drive leaves behind; `world`: all of it, and the voltmeter at its channels.
"""
