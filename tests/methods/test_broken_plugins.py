"""A package whose entry points cannot be used is named in one sentence, and everything else goes on working."""

import pytest

from tumble import plugins
from tumble.app.jobs import find_job
from tumble.app.methods import method_called, methods
from tumble.drivers.driver import find_head
from tumble.procedures.errors import InputError
from tumble.procedures.registry import find_method, usable_methods
from tumble.window.method import WindowPart
from tumble.window.registry import window_part

BROKEN = {
    "absent:X": "ModuleNotFoundError: No module named 'absent'",
    "broken_part:NOWHERE": "AttributeError: module 'broken_part' has no attribute 'NOWHERE'",
    "broken_part:NUMBER": "it lacks ",
    "broken_part:HALF": "it lacks ",
    "raising_part:X": "RuntimeError: no {licence}",
    "leaving_part:X": "SystemExit: 3",
    "misspelt_part:X": "SyntaxError: ",
}
MODULES = {
    "broken_part": "class Half:\n    name = 'broken'\nHALF, NUMBER = Half(), 7\n",
    "raising_part": "raise RuntimeError('no {licence}\\nsecond line')\n",
    "leaving_part": "raise SystemExit(3)\n",
    "misspelt_part": "def f(:\n",
}
INSTALLED = ["dividing_head", "gyrocompass", "head_reference", "temperature", "triad"]
GROUPS = ("tumble.methods", "tumble.procedures", "tumble.jobs", "tumble.window", "tumble.heads")

METHODS = ["dividing_head", "head_reference", "temperature", "triad", "vibration"]


@pytest.fixture(autouse=True)
def forgotten():
    """Nothing remembered of the packages that another test saw."""
    caches = (plugins._named, plugins._entry_points, plugins.warn_once, methods, method_called, window_part)
    for cache in caches:
        cache.cache_clear()
    yield
    for cache in caches:
        cache.cache_clear()


@pytest.fixture
def installed(tmp_path, monkeypatch):
    """Installs a package of these entry points, the same in every group."""
    for name, text in MODULES.items():
        (tmp_path / f"{name}.py").write_text(text)
    monkeypatch.syspath_prepend(str(tmp_path))

    def install(line, package="broken"):
        folder = tmp_path / f"{package}-1.dist-info"
        folder.mkdir()
        (folder / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {package}\nVersion: 1\n")
        (folder / "entry_points.txt").write_text("".join(f"[{group}]\n{line}\n" for group in GROUPS))

    return install


@pytest.mark.parametrize(("value", "why"), BROKEN.items())
def test_a_method_that_cannot_be_used_is_refused_in_one_sentence(installed, value, why):
    installed(f"broken = {value}")
    with pytest.raises(ValueError, match=r"^broken of tumble\.procedures in the package broken") as refused:
        find_method("broken")
    assert why in str(refused.value)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("value", BROKEN)
def test_analysis_and_job_that_cannot_be_used_are_bad_input(installed, value):
    installed(f"broken = {value}")
    for find in (method_called, find_job):
        with pytest.raises(InputError, match="in the package broken cannot be used"):
            find("broken")


@pytest.mark.parametrize("value", BROKEN)
def test_all_other_methods_are_found(installed, value, caplog):
    installed(f"broken = {value}")
    assert [method.name for method in methods()] == [
        "dividing_head",
        "gyrocompass",
        "head_reference",
        "temperature",
        "triad",
        "vibration",
    ]
    assert [method.name for method in usable_methods()] == ["dividing_head", "gyrocompass", "triad", "vibration"]
    assert [record.message.split(" in ")[0] for record in caplog.records] == [
        "broken of tumble.methods",
        "broken of tumble.procedures",
    ]


def test_a_broken_part_of_the_window_is_shown_as_of_any_method(installed, caplog):
    installed("broken = raising_part:X")
    assert window_part("broken").tabs is WindowPart().tabs
    assert "RuntimeError: no {licence}" in caplog.text


def test_a_driver_that_cannot_be_imported_is_refused(installed, tmp_path):
    installed("broken = raising_part:X")
    with pytest.raises(ValueError, match=r"broken of tumble\.heads in the package broken"):
        find_head("broken", tmp_path)


def test_a_name_that_two_packages_give_is_refused(installed):
    installed("twice = raising_part:X", "one")
    installed("twice = broken_part:HALF", "two")
    with pytest.raises(InputError, match=r"named by more than one package \(one, two\); uninstall all but one"):
        method_called("twice")


def test_a_method_goes_by_the_name_of_its_entry_point(installed):
    installed("other = tumble.calibrations.methods.temperature.method:METHOD")
    with pytest.raises(InputError, match="it calls itself 'temperature'"):
        method_called("other")


def test_entry_points_that_cannot_be_parsed_stop_no_other_package(installed, caplog):
    installed("no sign of equality")
    assert [method.name for method in methods()] == [
        "dividing_head",
        "gyrocompass",
        "head_reference",
        "temperature",
        "triad",
        "vibration",
    ]
    assert caplog.records[0].message.startswith("the entry points of the package broken cannot be read")


def test_a_package_is_hidden_by_one_of_its_name_before_it_on_the_path(installed, tmp_path, monkeypatch):
    installed("other = raising_part:X")
    before = tmp_path / "before" / "broken-2.dist-info"
    before.mkdir(parents=True)
    (before / "METADATA").write_text("Metadata-Version: 2.1\nName: broken\nVersion: 2\n")
    assert "other" in plugins.names("tumble.methods")
    monkeypatch.syspath_prepend(str(before.parent))
    assert "other" not in plugins.names("tumble.methods")


def test_of_a_package_that_brings_nothing_along_not_even_the_name_is_read(installed, tmp_path):
    installed("other = raising_part:X")
    (tmp_path / "nameless-1.dist-info").mkdir()
    assert "other" in plugins.names("tumble.methods")
