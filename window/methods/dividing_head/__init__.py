"""An accelerometer on a dividing head, in the window."""
