"""What program is running: version, commit, packages."""

import subprocess
from dataclasses import dataclass
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

_PACKAGES = ("numpy", "scipy", "pydantic", "SQLAlchemy", "mcap", "orjson", "jinja2")
_ROOT = Path(__file__).resolve().parents[1]


@dataclass(frozen=True, kw_only=True)
class ProgramIdentity:
    """Enough to find this program again."""

    version: str
    git_commit: str
    """Empty where the program does not run from a checkout."""
    git_dirty: bool
    packages: dict[str, str]


@cache
def program_identity() -> ProgramIdentity:
    """Identify the running program, once."""
    commit = _git("rev-parse", "HEAD") if (_ROOT / ".git").exists() else ""
    return ProgramIdentity(
        version=_version("tumble"),
        git_commit=commit,
        git_dirty=bool(commit and _git("status", "--porcelain", "--untracked-files=no")),
        packages={name: _version(name) for name in _PACKAGES},
    )


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "not installed"


def _git(*arguments: str) -> str:
    try:
        result = subprocess.run(["git", *arguments], cwd=_ROOT, capture_output=True, text=True, timeout=10, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return result.stdout.strip() if result.returncode == 0 else ""
