"""What the window shows of vibration rectification."""
