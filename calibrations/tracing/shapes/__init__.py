"""Shapes that structure without a name may have along a variable, each with what it explains beside what was found."""
