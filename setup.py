"""Everything that setuptools is told stands in pyproject.toml; this file only looks whether the checkout is whole."""

import sys
from pathlib import Path

from setuptools import setup

LINKED = ("app", "calibrations", "drivers", "emulators", "procedures", "window")

missing = [name for name in LINKED if not (Path(__file__).parent / "tumble" / name).is_dir()]
if missing:
    sys.exit(
        f"tumble/{missing[0]} is no folder but should be a link to ../{missing[0]}: the checkout was made without "
        "symbolic links; clone again with `git clone -c core.symlinks=true`, or install the wheel"
    )
setup()
