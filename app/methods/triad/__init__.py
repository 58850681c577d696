"""The job of a triad at a stand: fitted, traced, recorded, reported.

- `analysed`: a raw file with its fit, and with the loop closed; `job`: what registers it.
"""
