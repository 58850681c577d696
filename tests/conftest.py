"""What several tests share."""

import gc
import os
import signal
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Final

import pytest
from hypothesis import settings

from benchmarks.frozen import KERNELS
from tumble.app.cli import limit_blas_threads

os.environ.setdefault("OPENBLAS_CORETYPE", KERNELS)  # before numpy is loaded
limit_blas_threads()  # as the program does
signal.signal(signal.SIGINT, signal.default_int_handler)  # programs that tests start hear it, in the background too
if hasattr(signal, "SIGHUP"):
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
settings.register_profile("any machine", deadline=None)  # a busy machine is no failure
settings.load_profile("any machine")

UNTRACED: Final = frozenset(
    {
        "app/test_active_loop.py",
        "app/test_other_tables.py",
        "app/test_resume_command.py",
        "app/test_stand_command.py",
        "benchmarks/test_endurance_kills.py",
        "benchmarks/test_endurance_meters.py",
        "benchmarks/test_endurance_pairs.py",
        "benchmarks/test_loop_running.py",
        "benchmarks/test_window_streaming.py",
        "calibrations/test_report_loop.py",
        "calibrations/test_stand_evidence.py",
        "calibrations/test_temperature_loop.py",
        "calibrations/test_tracing_evidence.py",
        "calibrations/test_tracing_noise.py",
        "calibrations/test_verdict.py",
        "drivers/test_scpi_plain.py",
        "frozen/test_frozen_runs.py",
        "measured/test_frozen_tables.py",
        "procedures/test_recording_durability.py",
        "window/test_further_experiment.py",
        "window/test_pause_and_stop.py",
        "window/test_stop_everywhere.py",
        "window/test_whole_run.py",
    }
)
"""Files of long tests that count nothing towards coverage: tracing every line adds two thirds to their time.

Most of what they reach is reached by others, too: 94% is covered without them, 98% with them.
"""


@pytest.fixture(scope="module", autouse=True)
def untraced(request: pytest.FixtureRequest) -> Iterator[None]:
    """Trace nothing in `UNTRACED`."""
    if request.path.relative_to(Path(__file__).parent).as_posix() not in UNTRACED:
        yield
        return
    here, in_threads = sys.gettrace(), threading.gettrace()
    sys.settrace(None)
    threading.settrace(None)
    yield
    threading.settrace(in_threads)
    sys.settrace(here)


def pytest_collection_finish() -> None:
    """Keep what thousands of collected tests hold out of the search for garbage."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(20_000, 20, 20)


@pytest.fixture(scope="session", autouse=True)
def one_namespace():
    """Everything is imported as `tumble.*`: under two names there would be two of every class."""
    yield
    assert not {"app", "calibrations", "drivers", "emulators", "procedures", "window"} & sys.modules.keys()


@pytest.fixture(scope="session")
def shared() -> Path:
    """Folder with measured and blind-made tables beside the checkout; where it is absent, tests of them say so."""
    folder = Path(__file__).resolve().parents[2] / "shared"
    if not folder.is_dir():
        pytest.skip(f"needs the tables in {folder}, which is not there")
    return folder


@pytest.fixture
def install(tmp_path_factory, monkeypatch):
    """Installs a package of one entry point as long as a test runs."""

    def installed(group: str, name: str, value: str) -> None:
        site = tmp_path_factory.mktemp("site")
        package = site / f"{name}_of_{group.replace('.', '_')}-1.dist-info"
        package.mkdir()
        (package / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {package.stem[:-2]}\nVersion: 1\n")
        (package / "entry_points.txt").write_text(f"[{group}]\n{name} = {value}\n")
        monkeypatch.syspath_prepend(str(site))

    return installed
