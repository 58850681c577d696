"""What runs of an accelerometer say of their stand, and what a stand record takes off them."""
