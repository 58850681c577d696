"""The application: stand files, wiring, jobs and the command line. The other packages know nothing of it."""
