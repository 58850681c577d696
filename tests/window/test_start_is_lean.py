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


STANDS = """\
import sys
from tumble.app.stand import load_stand
from tumble.procedures.registry import usable_methods
loaded = [load_stand(None, method.name) for method in usable_methods()]
print("scipy.signal" in sys.modules, len(loaded) > 3)
"""


def test_a_stand_that_is_built_in_needs_no_signal_processing():
    done = subprocess.run([sys.executable, "-c", STANDS], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["False", "True"]
