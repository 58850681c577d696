"""A wheel, installed in an environment of its own outside the checkout, does everything."""

import os
import shutil
import subprocess
import sys
import sysconfig
import venv
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
BIN = "Scripts" if os.name == "nt" else "bin"
TRANSLATED = """\
import sys
from tumble.messages import Language
from tumble.window.look.language import speak, tr
from tumble.window.start import application
application()
speak(Language(sys.argv[1]))
print(tr("Records"))
"""


class Installed:
    """The environment; what it depends on comes from the one that runs the tests."""

    def __init__(self, folder: Path):
        self.folder = folder

    def begin(self, *command):
        env = {
            **{name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "COV"))},
            "PYTHONPATH": sysconfig.get_path("purelib"),
            "QT_QPA_PLATFORM": "offscreen",
            "XDG_STATE_HOME": str(self.folder / "state"),
        }
        place = self.folder / "env" / BIN / command[0]
        pipe = subprocess.PIPE
        return subprocess.Popen([place, *command[1:]], cwd=self.folder, env=env, stdout=pipe, stderr=pipe, text=True)

    def run(self, *command):
        with self.begin(*command) as process:
            out, err = process.communicate(timeout=120)
        assert process.returncode == 0, err
        return out


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    pip = [sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check"]
    source = folder / "source"  # a clean one: a stale build folder would ship modules that are gone
    subprocess.run(["git", "clone", "--quiet", "--local", ROOT, source], check=True)
    build = [*pip, "wheel", "--no-deps", "--no-build-isolation", "--wheel-dir", folder, source]
    subprocess.run(build, check=True, capture_output=True)
    (wheel,) = folder.glob("*.whl")
    venv.create(folder / "env", with_pip=False)
    python = folder / "env" / BIN / "python"
    subprocess.run([*pip, "--python", python, "install", "--no-deps", wheel], check=True, capture_output=True)
    return Installed(folder)


def test_it_is_imported_from_where_it_is_installed_and_under_one_name(installed):
    asked = (
        "import tumble.app, importlib.util as u; print(tumble.app.__file__, u.find_spec('app'), u.find_spec('drivers'))"
    )

    file, *others = installed.run("python", "-c", asked).split()

    assert Path(file).is_relative_to(installed.folder / "env")
    assert others == ["None", "None"]


def test_it_brings_the_handbook_along(installed):
    asked = "from tumble.window.handbook import handbook; print(*sorted(page.name for page in handbook().iterdir()))"

    pages = installed.run("python", "-c", asked).split()

    assert {"index.md", "window.md", "window"} <= set(pages)


def test_it_does_the_whole_job_and_reports(installed):
    installed.run("tumble", "calibrate", "--programme", "quick", "--serial", "W-1", "--store", "records")

    installed.run("tumble", "records", "verify", "--store", "records")

    (report,) = (installed.folder / "records" / "reports").glob("*.html")
    assert report.read_text("utf-8").rstrip().endswith("</html>")


@pytest.mark.parametrize(("language", "records"), [("uk", "Записи"), ("de", "Aufzeichnungen")])
def test_its_window_speaks_other_languages(installed, language, records):
    assert installed.run("python", "-c", TRANSLATED, language).strip() == records


@pytest.mark.skipif(os.name == "nt", reason="there is no such signal on Windows")
def test_it_serves_an_emulated_stand_until_it_is_told_to_end(installed):
    with installed.begin("tumble", "emulate", "--head-port", "0", "--daq-port", "0") as process:
        told = process.stdout.readline()
        process.terminate()
        process.communicate(timeout=60)

    assert "socket://127.0.0.1:" in told
    assert process.returncode == 4


def test_it_reads_the_dbc_file_and_the_programmes_that_come_along(installed):
    assert "seed" in installed.run("tumble", "plan", "seed")
    installed.run("python", "-c", "from tumble.drivers.candaq import DaqFrames; DaqFrames.from_file()")


def test_a_store_of_an_older_version_is_migrated(installed):
    old = installed.folder / "old"
    shutil.copytree(ROOT / "tests" / "calibrations" / "fixtures" / "store_0_1", old)
    assert "records.sqlite: migrated" in installed.run("tumble", "records", "migrate", "--store", old)
