"""Programs that measure this project; run from the root of the repository."""
