"""A report as PDF, set by typst: the same content as the HTML page, with its own fonts and no others."""

import json
from pathlib import Path
from typing import Final

import typst

from tumble.calibrations.report.document import Report
from tumble.calibrations.report.written import written

_TEMPLATE: Final = Path(__file__).parent / "report.typ"


def pdf(report: Report) -> bytes:
    """The document, in the language of `written_in`; the same input gives the same bytes."""
    content = json.dumps(written(report), ensure_ascii=False)
    made = typst.compile(_TEMPLATE.read_bytes(), ignore_system_fonts=True, sys_inputs={"report": content}, format="pdf")
    assert isinstance(made, bytes), "a PDF is one file"
    return made
