"""Where the handbook lies, of which the window shows the pages."""

from pathlib import Path
from typing import Final

import tumble

FIRST_PAGE: Final = "window.md"
CONTENTS: Final = "index.md"


def handbook() -> Path | None:
    """The folder of its pages: in the package that is installed, or in the checkout; None where it was left out."""
    package = Path(tumble.__file__).resolve().parent
    return next((each for each in (package / "handbook", package.parent / "docs") if (each / CONTENTS).is_file()), None)
