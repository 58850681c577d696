"""What the window shows of a triad on a two-axis stand."""
