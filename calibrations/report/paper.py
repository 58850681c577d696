"""A report in words as PDF, set by typst: the same content as the page, with its own fonts and no others."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import typst

_TEMPLATE: Final = Path(__file__).parent / "report.typ"


def pdf(content: Mapping[str, Any]) -> bytes:
    """The document of what `written` made; the same content gives the same bytes."""
    said = json.dumps(content, ensure_ascii=False)
    made = typst.compile(_TEMPLATE.read_bytes(), ignore_system_fonts=True, sys_inputs={"report": said}, format="pdf")
    assert isinstance(made, bytes), "a PDF is one file"
    return made
