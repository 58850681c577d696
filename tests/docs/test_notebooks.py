"""The notebooks run from beginning to end, use the public API alone, and are kept without outputs."""

import ast
import json
from pathlib import Path

import pytest

import tumble

FOLDER = Path(__file__).parents[2] / "docs" / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))


def cells_of(path):
    return [cell for cell in json.loads(path.read_text("utf-8"))["cells"] if cell["cell_type"] == "code"]


def run_cell(source, names):
    """Run a cell; what its last line gives is shown as a notebook shows it."""
    tree = ast.parse(source)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, "cell", "exec"), names)
    if last is not None:
        shown = eval(compile(ast.Expression(last.value), "cell", "eval"), names)
        for form in ("_repr_html_", "_repr_svg_"):
            getattr(shown, form, lambda: None)()


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(path, monkeypatch, capsys):
    monkeypatch.chdir(FOLDER)
    names = {}
    for cell in cells_of(path):
        run_cell("".join(cell["source"]), names)


def test_all_three_are_there():
    assert [path.stem for path in NOTEBOOKS] == ["closing-the-loop", "first-calibration", "own-driver"]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_they_import_tumble_alone(path):
    trees = [ast.parse("".join(cell["source"])) for cell in cells_of(path)]
    nodes = [node for tree in trees for node in ast.walk(tree)]
    imported = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    used = {
        node.attr
        for node in nodes
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "tumble"
    }
    outside = {node.module for node in nodes if isinstance(node, ast.ImportFrom)} - {"pathlib", "tempfile"}

    assert imported <= {"tumble", "pandas"}
    assert outside == set()
    assert used <= set(tumble.__all__)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_outputs_are_made_with_the_site(path):
    assert all(cell["outputs"] == [] and cell["execution_count"] is None for cell in cells_of(path))
