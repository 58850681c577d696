"""What each calibration method asks of a stand, a package each. None knows another."""
