"""Blocks of code in the pages: what is run, and how."""

import re
import shlex
from dataclasses import dataclass
from pathlib import Path

from app_jobs import tumble

ROOT = Path(__file__).parents[2]
PAGES = (ROOT / "README.md", *sorted(p for p in (ROOT / "docs").rglob("*.md") if "_site" not in p.parts))
RUN = ("sh", "console", "python")
_BLOCK = re.compile(r"(?:^<!-- not run: (?P<reason>.+?) -->\n)?^```(?P<kind>\w+)\n(?P<text>.*?)^```$", re.M | re.S)


@dataclass(frozen=True, kw_only=True)
class Block:
    """A fenced block of a page, and why it is not run where it is not."""

    kind: str
    text: str
    reason: str | None

    @property
    def commands(self):
        """Lines that a shell would run, each as words."""
        lines = (line.removeprefix("$ ") for line in self.text.splitlines())
        return [words for line in lines if (words := shlex.split(line, comments=True))]


def blocks_of(page):
    """Blocks in the languages that are run, in their order."""
    found = (Block(**match.groupdict()) for match in _BLOCK.finditer(page.read_text("utf-8")))
    return [block for block in found if block.kind in RUN]


def run_page(page):
    """Run every block of a page in the current folder, one after the other, as a reader would."""
    names = {"__name__": "__main__"}
    for block in blocks_of(page):
        if block.reason:
            continue
        if block.kind == "python":
            exec(compile(block.text, str(page), "exec"), names)
        for program, *arguments in block.commands if block.kind != "python" else ():
            assert program == "tumble", f"{page.name}: {program} is not run here: give the block a reason"
            ran = tumble(*arguments)
            assert ran.status == 0, f"{page.name}: tumble {shlex.join(arguments)}: {ran.status}, {ran.err}"


def links_of(page):
    """Targets of links and pictures that point into the repository."""
    text = re.sub(r"^```.*?^```$", "", page.read_text("utf-8"), flags=re.M | re.S)
    targets = re.findall(r"\]\(([^)#\s]+)", text)
    return [target for target in targets if not target.startswith(("http:", "https:"))]
