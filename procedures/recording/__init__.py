"""Recordings: the journal of a run, and the raw data of a calibration (MCAP)."""
