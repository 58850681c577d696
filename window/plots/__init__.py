"""What every plot of the window can do beside drawing: tell its values at a cursor, be copied and be saved."""
