"""What several tests share."""

import signal
from pathlib import Path

import pytest
from hypothesis import settings

from app.cli import limit_blas_threads

limit_blas_threads()  # as the program does, before numpy is loaded
signal.signal(signal.SIGINT, signal.default_int_handler)  # programs that tests start hear it, in the background too
if hasattr(signal, "SIGHUP"):
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
settings.register_profile("any machine", deadline=None)  # a busy machine is no failure
settings.load_profile("any machine")


@pytest.fixture(scope="session")
def shared() -> Path:
    """Folder with measured and blind-made tables beside the checkout; where it is absent, tests of them say so."""
    folder = Path(__file__).resolve().parents[2] / "shared"
    if not folder.is_dir():
        pytest.skip(f"needs the tables in {folder}, which is not there")
    return folder
