"""What every method shares: arrays, rows, quantities, parameters, least squares, evidence. It knows no method."""
