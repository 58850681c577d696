"""The loop closed on one table of an accelerometer."""
