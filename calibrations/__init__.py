"""The analysis: observations, geometry, models, fit, residuals, records and report.

Knows no instrument, no recording format and no window: what it reads is an observation table.
"""
