"""The job of vibration rectification: fitted, traced, recorded, reported.

- `analysed`: a raw file with its fit, and with the loop closed; `job`: what registers it.
"""
