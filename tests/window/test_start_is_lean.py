"""A window is up before the analysis is loaded, and before anything is looked for in the store."""

import subprocess
import sys

from tumble.procedures.programmes import shipped_programmes

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


def test_records_are_looked_for_once_the_window_is_painted(driver):
    records = driver.window.records
    assert not driver.window.background.is_busy and not records.surveyor.is_busy
    with driver.bot.waitSignal(records.shown, timeout=60_000):
        pass


def test_programmes_that_come_along_are_looked_up_once(monkeypatch):
    shipped_programmes()
    monkeypatch.setattr("tumble.procedures.programmes.usable_methods", lambda: 1 / 0)
    assert "seed" in shipped_programmes()
