"""What runs of a triad say of their stand, and how later runs are corrected by it."""
