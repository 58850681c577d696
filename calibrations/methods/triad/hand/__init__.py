"""A triad without a stand: moved by hand through many poses and held still in each; the scalar fit of what it read."""
