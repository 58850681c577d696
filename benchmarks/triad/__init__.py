"""Simulated tables of triads on a two-axis stand, and what the closed loop says of them."""
