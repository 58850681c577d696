import subprocess
import sys

import pytest
from click.testing import CliRunner

from tumble.app.cli import cli
from tumble.window import libraries


def test_the_command_line_starts_without_qt():
    looked = "import sys, app.cli, window.command; print(sorted(m for m in sys.modules if 'PySide' in m))"
    ran = subprocess.run([sys.executable, "-c", looked], capture_output=True, text=True, check=True)
    assert ran.stdout.strip() == "[]"


def test_help_names_the_window():
    assert "Open the operator's window." in CliRunner().invoke(cli, ["--help"]).output


@pytest.mark.skipif(sys.platform != "linux", reason="screens are opened otherwise there")
def test_no_screen_is_a_sentence(monkeypatch):
    for name in ("QT_QPA_PLATFORM", "DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    assert libraries.obstacle().startswith("there is no screen here")


@pytest.mark.skipif(sys.platform != "linux", reason="screens are opened otherwise there")
def test_a_missing_library_is_a_sentence_that_names_the_packages(monkeypatch, tmp_path):
    monkeypatch.delenv("QT_QPA_PLATFORM", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    monkeypatch.setenv("DISPLAY", ":77")
    monkeypatch.setattr(libraries, "_plugin", lambda: tmp_path / "libqxcb.so")
    sentence = libraries.obstacle()
    assert "libqxcb.so" in sentence
    assert sentence.endswith("apt-get install " + libraries.DEBIAN)


def test_no_qt_at_all_is_a_sentence(monkeypatch):
    monkeypatch.setattr(libraries, "find_spec", lambda _: None)
    ran = CliRunner().invoke(cli, ["gui"])
    assert str(ran.exception) == (
        "the window needs PySide6-Essentials and pyqtgraph, which are not installed; run make setup"
    )
