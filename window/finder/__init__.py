"""Finding whatever the window can do by a part of its name."""
