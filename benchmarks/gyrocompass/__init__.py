"""Benchmarks of gyrocompassing on simulated platforms."""
