"""The report on an accelerometer: what it says, for page and paper."""

from tumble.calibrations.methods.dividing_head.report.page import calibration_report

__all__ = ["calibration_report"]
