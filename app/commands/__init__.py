"""One module for every command of `tumble`, each with a `command`."""
