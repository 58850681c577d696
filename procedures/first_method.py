"""The method of programmes and recordings that name none."""

from typing import Final

FIRST: Final = "dividing_head"
"""Version 0.1 knew no other."""
