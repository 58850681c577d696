"""Gyrocompassing at a stand, as the application sees it.

- `job`: what the entry point names; `analysed`: a raw file fitted and traced; `expectation`: what a plan promises.
"""
