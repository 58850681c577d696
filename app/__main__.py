"""`python -m app` is `tumble`."""

from app.cli import main

main()
