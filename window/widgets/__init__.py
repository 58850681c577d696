"""Small parts of which the screens are made, one a file."""
