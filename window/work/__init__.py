"""What goes on outside the event loop: instruments in one thread, analysis and storage in another."""
