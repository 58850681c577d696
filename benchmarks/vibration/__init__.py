"""Simulated vibration rectification: the waveform of every dwell averaged sample by sample."""
