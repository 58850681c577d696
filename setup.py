"""Looks whether a checkout is whole and compiles its catalogues; what is built stands in pyproject.toml."""

import shutil
import sys
from pathlib import Path
from typing import ClassVar

from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po
from setuptools import Command, setup
from setuptools.command.build_py import build_py

HERE = Path(__file__).parent
HANDBOOK = ("*.md", "*.png", "window/*.png", "decisions/*.md")
"""What the window shows of `docs`."""
LINKED = ("app", "calibrations", "drivers", "emulators", "procedures", "window")

for name in LINKED:
    if not (HERE / "tumble" / name).is_dir():
        sys.exit(
            f"tumble/{name} is no folder but should be a link to ../{name}: the checkout was made without symbolic "
            "links; clone again with `git clone -c core.symlinks=true`, or install the wheel"
        )


class CompileCatalogues(Command):
    """Compiles every catalogue of messages beside its source, where a checkout reads it and a wheel takes it."""

    user_options: ClassVar[list[tuple[str, str, str]]] = []

    def initialize_options(self) -> None:
        """Nothing can be chosen."""

    def finalize_options(self) -> None:
        """Nothing was chosen."""

    def run(self) -> None:
        """Compile them all; Babel's own command takes `95% interval` for a faulty template."""
        for source in (HERE / "tumble" / "locales").rglob("*.po"):
            with source.open("rb") as catalogue, source.with_suffix(".mo").open("wb") as compiled:
                write_mo(compiled, read_po(catalogue))


class BuildWithCatalogues(build_py):
    """Builds what stands in pyproject.toml, the compiled catalogues and the handbook included."""

    def finalize_options(self) -> None:
        """Compile before the files that a package brings along are counted."""
        self.run_command("compile_catalogues")
        super().finalize_options()

    def run(self) -> None:
        """Build, and put the handbook into the package; a checkout reads it where it is written."""
        super().run()
        if self.editable_mode:
            return
        for page in (page for pattern in HANDBOOK for page in (HERE / "docs").glob(pattern)):
            place = Path(self.build_lib) / "tumble" / "handbook" / page.relative_to(HERE / "docs")
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(page, place)


setup(cmdclass={"build_py": BuildWithCatalogues, "compile_catalogues": CompileCatalogues})
