"""What runs of a gyro platform say of their turntable, and how later runs are corrected by it."""
