"""What everything in the window has in common to the eye: colours, text, language, plots."""
