import os
import subprocess
import sys
from pathlib import Path

import pytest
from app_jobs import STAND, tumble

ROOT = Path(__file__).resolve().parents[2]
COMMANDS = ["calibrate", "run", "plan", "fit", "close-loop", "report", "records", "export"]
LOOK = """
import sys
from tumble.app.cli import main
sys.argv = ["tumble", "--help"]
main()
heavy = {"numpy", "scipy", "matplotlib", "pydantic", "rich", "sqlalchemy", "mcap", "PySide6"}
print(sorted(heavy & set(sys.modules)), file=sys.stderr)
"""


def python(*arguments):
    return subprocess.run(
        [sys.executable, *map(str, arguments)], cwd=ROOT, capture_output=True, encoding="utf-8", timeout=60, check=False
    )


def test_what_is_redirected_is_utf_8_whatever_the_system_writes_otherwise(tmp_path):
    (tmp_path / "one.toml").write_text('name = "Жук″"\n[[procedure]]\nkind = "flip"\naxes = ["x"]\n', "utf-8")
    command = [sys.executable, "-m", "tumble", "plan", str(tmp_path / "one.toml")]
    environment = {**os.environ, "PYTHONIOENCODING": "cp1252"}  # as on Windows
    ran = subprocess.run(command, cwd=ROOT, capture_output=True, timeout=60, check=False, env=environment)
    assert ran.returncode == 0, ran.stderr
    assert "Жук″" in ran.stdout.decode("utf-8")


def test_help_waits_for_no_heavy_library():
    ran = python("-c", LOOK)

    assert ran.stderr.strip() == "[]"
    assert all(f"  {name} " in ran.stdout for name in COMMANDS)


@pytest.mark.parametrize("command", [[name] for name in COMMANDS] + [["records", name] for name in
                         ("list", "show", "compare", "export", "verify")], ids=" ".join)  # fmt: skip
def test_every_command_has_a_help_of_its_own(command):
    ran = tumble(*command, "-h")

    assert ran.status == 0
    assert ran.out.startswith(f"Usage: tumble {' '.join(command)}")


def test_help_is_a_good_end():
    assert tumble("--help").status == 0


def test_no_command_at_all_is_wrong_usage():
    assert tumble().status == 2


def test_the_version_is_told():
    assert tumble("--version").out.startswith("tumble, version ")


def test_python_m_app_is_tumble_and_its_exit_status_reaches_the_shell(write):
    stand = write("bad.toml", STAND.replace("limits_deg", "limit_deg"))

    ran = python("-m", "tumble", "plan", "quick", "--stand", stand)

    assert ran.returncode == 2
    assert ran.stderr.startswith(f"tumble: {stand}, line 6: head: limits_deg: Field required; add it")
