"""The report: a calibration as one self-contained HTML page that prints on A4."""

from tumble.calibrations.methods.dividing_head.report.page import render_report

__all__ = ["render_report"]
