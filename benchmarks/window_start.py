"""How long it takes from the command to a window that is painted and heeds keys: every time a new process.

Modules are compiled by the first start, which does not count, as an installer does.
"""

import argparse
import os
import statistics
import subprocess
import sys
import tempfile
import time

_CODE = """
import gc
import sys
from pathlib import Path
from PySide6.QtCore import QSettings
from tumble.window.libraries import obstacle
assert not obstacle(), obstacle()
gc.disable()
from tumble.window.painted import FirstPaint
from tumble.window.start import Application, application
QSettings.setDefaultFormat(QSettings.Format.IniFormat)
QSettings.setPath(QSettings.Format.IniFormat, QSettings.Scope.UserScope, sys.argv[1])
qt = application()
running = Application(qt, Path(sys.argv[1]) / "store")
def up():
    print("up", flush=True)
    running.window.leave()
FirstPaint(running.window.windowHandle(), running.window).painted.connect(up)
qt.exec()
"""


def once(compiled: str) -> float:
    """Seconds from the start of the process until its window is up, with compiled modules in a folder of their own."""
    with tempfile.TemporaryDirectory() as folder:
        began_s = time.perf_counter()
        command = [sys.executable, "-c", _CODE, folder]
        told = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
        quiet = subprocess.DEVNULL
        with subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=quiet, text=True, env=told | {"PYTHONPYCACHEPREFIX": compiled}
        ) as process:
            assert process.stdout is not None
            if process.stdout.readline().strip() != "up":
                raise SystemExit("the window did not come up")
            return time.perf_counter() - began_s


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--rounds", type=int, default=9)
    rounds = arguments.parse_args().rounds
    with tempfile.TemporaryDirectory() as compiled:
        once(compiled)
        taken_s = [once(compiled) for _ in range(rounds)]
    platform = os.environ.get("QT_QPA_PLATFORM", "the screen")
    print(
        f"{platform}: {statistics.median(taken_s):.2f} s (median of {rounds}; {min(taken_s):.2f} to {max(taken_s):.2f})"
    )


if __name__ == "__main__":
    main()
