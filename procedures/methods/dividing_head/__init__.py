"""An accelerometer on a dividing head: flips and sweeps, mounts, and heads that are read by eye."""
