"""Looks whether a checkout is whole before it is built; what is built stands in pyproject.toml."""

import sys
from pathlib import Path

from setuptools import setup

HERE = Path(__file__).parent
LINKED = ("app", "calibrations", "drivers", "emulators", "procedures", "window")
COMPILED = HERE / "window" / "translations" / "tumble_uk.qm"

for name in LINKED:
    if not (HERE / "tumble" / name).is_dir():
        sys.exit(
            f"tumble/{name} is no folder but should be a link to ../{name}: the checkout was made without symbolic "
            "links; clone again with `git clone -c core.symlinks=true`, or install the wheel"
        )
if "bdist_wheel" in sys.argv and not COMPILED.is_file():
    sys.exit(
        "window/translations/tumble_uk.qm is not there, and the wheel would speak English only; run `make setup` first"
    )
setup()
