"""What is in a package: modules and public names, with the first paragraph of each docstring; nothing is imported."""

import ast
from collections.abc import Iterator
from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import Directive
from sphinx.application import Sphinx

ROOT = Path(__file__).parents[2]


def paragraph(text: str) -> nodes.paragraph:
    """Plain text with `code` in backticks."""
    pieces = text.split("`")
    made = [nodes.literal(piece, piece) if n % 2 else nodes.Text(piece) for n, piece in enumerate(pieces) if piece]
    return nodes.paragraph("", "", *made)


def summary(node: ast.Module | ast.ClassDef | ast.FunctionDef) -> str:
    """First paragraph of a docstring, on one line."""
    return " ".join((ast.get_docstring(node) or "").partition("\n\n")[0].split())


def public(module: ast.Module) -> Iterator[ast.ClassDef | ast.FunctionDef]:
    """Functions and classes that are not private."""
    for node in module.body:
        if isinstance(node, ast.ClassDef | ast.FunctionDef) and not node.name.startswith("_"):
            yield node


def entry(term: str, *definition: nodes.Element) -> nodes.definition_list_item:
    """A name in code with what it is."""
    return nodes.definition_list_item(
        "", nodes.term("", "", nodes.literal(term, term)), nodes.definition("", *definition)
    )


def described(path: Path) -> nodes.definition_list_item:
    """A module with its public names."""
    module = ast.parse(path.read_text("utf-8"))
    names = [entry(node.name, paragraph(summary(node))) for node in public(module)]
    relative = path.relative_to(ROOT).with_suffix("")
    parts = relative.parts[:-1] if relative.name == "__init__" else relative.parts
    listed = [nodes.definition_list("", *names)] if names else []
    return entry(".".join(("tumble", *parts)), paragraph(summary(module)), *listed)


class PackageIndex(Directive):
    """`package-index:: calibrations`: the modules of a folder, package by package."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Describe every module, a package before what is in it."""
        paths = sorted((ROOT / self.arguments[0]).rglob("*.py"), key=lambda path: (path.parent, path.name))
        self.state.document.settings.env.note_dependency(str(ROOT / self.arguments[0]))
        return [nodes.definition_list("", *map(described, paths))]


def setup(app: Sphinx) -> dict[str, bool]:
    """Offer the directive."""
    app.add_directive("package-index", PackageIndex)
    return {"parallel_read_safe": True}
