"""What the description of a user's files lists is what the program knows."""

import re
from pathlib import Path
from typing import Final, get_args

from tumble.emulators.faults import Kind

FILES: Final = Path(__file__).parents[2] / "docs" / "files.md"
NO_KINDS: Final = {"tumble emulate --faults", "emulators/cia402_habits.py"}


def test_every_kind_of_fault_is_listed():
    section = FILES.read_text("utf-8").partition("## Fault file")[2].partition("\n## ")[0]
    listed = set(re.findall("`([^`]+)`", re.sub("```.*?```", "", section, flags=re.DOTALL))) - NO_KINDS

    assert listed == set(get_args(Kind))
