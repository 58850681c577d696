"""`python -m tumble` is `tumble`."""

from tumble.app.cli import main

main()
