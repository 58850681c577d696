"""What the methods bring along for the window."""
