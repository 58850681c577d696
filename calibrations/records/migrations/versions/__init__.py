"""One script for every version of the store."""
