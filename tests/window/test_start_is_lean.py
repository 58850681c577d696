"""A window is up before the analysis is loaded."""

import subprocess
import sys

OPENED = """\
import sys
import tumble.window.start
from tumble.procedures.first_method import FIRST
from tumble.window.registry import window_part
window_part(FIRST)
print(*sorted({name.partition(".")[0] for name in sys.modules} & {"scipy", "sqlalchemy", "typst", "jinja2"}))
"""


def test_what_the_window_begins_with_needs_no_analysis_and_no_store():
    done = subprocess.run([sys.executable, "-c", OPENED], capture_output=True, text=True, check=True)
    assert done.stdout.split() == []
