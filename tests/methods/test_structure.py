"""Only a method's own packages, and the registry, name it."""

import ast
import re
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path

import grimp
import pytest

ROOT = Path(__file__).resolve().parents[2]
NAMES = sorted(path.name for path in (ROOT / "calibrations" / "methods").iterdir() if (path / "method.py").is_file())
GENERIC = ("calibrations", "procedures", "drivers", "emulators", "app", "window")
FIRST = ROOT / "procedures" / "first_method.py"
"""Says which method files of version 0.1 are of, which do not say it themselves."""
INSTRUMENTS = ROOT / "drivers" / "protocols.py"
"""Names an instrument that is called like a method."""
MIGRATIONS = ROOT / "calibrations" / "records"
"""Holds what records of version 0.1 leave unsaid."""


def generic_files():
    for folder in GENERIC:
        for path in sorted((ROOT / folder).rglob("*.py")):
            if (
                "methods" not in path.relative_to(ROOT).parts
                and path not in (FIRST, INSTRUMENTS)
                and MIGRATIONS not in path.parents
            ):
                yield path


@cache
def names_in(path):
    """Literals, identifiers and imported modules of a file, identifiers in small letters with underscores."""
    return frozenset(_names_in(path))


def _names_in(path):
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value
        if isinstance(node, ast.ImportFrom) and node.module:
            yield from node.module.split(".")
        for attribute in ("id", "name", "attr", "arg", "asname"):
            if isinstance(named := getattr(node, attribute, None), str):
                yield re.sub(r"(?<=[a-z])(?=[A-Z])", "_", named).lower()


def test_there_are_methods():
    assert {"dividing_head", "head_reference", "temperature"} <= set(NAMES)


@pytest.mark.parametrize("name", ["dividing_head", "gyrocompass", "head_reference", "triad"])
def test_no_generic_file_names_a_method(name):
    word = re.compile(rf"(?<![a-z]){name}(?![a-z])")
    assert [path.relative_to(ROOT) for path in generic_files() if any(map(word.search, names_in(path)))] == []


@pytest.mark.parametrize("package", ["calibrations", "procedures", "app"])
@pytest.mark.parametrize("name", NAMES)
def test_a_methods_package_imports_no_other_method(name, package):
    others = {f"methods.{other}" for other in NAMES if other != name}
    for path in (ROOT / package / "methods" / name).rglob("*.py"):
        modules = {
            node.module for node in ast.walk(ast.parse(path.read_text("utf-8"))) if isinstance(node, ast.ImportFrom)
        }
        assert not [module for module in modules if module and any(other in module for other in others)]


def test_nothing_imports_in_a_circle_not_even_for_its_types():
    graph = grimp.build_graph("tumble", exclude_type_checking_imports=False, cache_dir=None)
    imported = {module: graph.find_modules_directly_imported_by(module) for module in graph.modules}
    assert len(list(TopologicalSorter(imported).static_order())) > 500  # raises `CycleError` on a circle
