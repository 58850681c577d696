"""The job of an accelerometer on a dividing head: what the application needs of the method."""
