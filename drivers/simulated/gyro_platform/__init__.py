"""The world of a gyro platform on an azimuth turntable; it shares no line with any analysis.

- `settings`: its table `[simulated]`, and `effects`, what may be injected there.
- `geometry`: where the earth turns and where is up, seen from the platform.
- `drift`: how the gyro drifts; `levelling`: the loop that holds the platform level.
- `platform`: what its channels say; `pickoff`: the turntable's angle errors.
- `world`: the turntable and the platform on it; `outputs`: what samples its channels.
"""
