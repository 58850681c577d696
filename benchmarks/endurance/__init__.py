"""Runs too long for every day: full counts of what the tests sample."""
