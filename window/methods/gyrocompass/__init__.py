"""What the window shows of gyrocompassing."""
