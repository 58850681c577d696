"""The exit status by which a command says what was decided."""

from tumble.app.exits import Exit
from tumble.calibrations.core.verdict import Verdict


def leave_by(verdict: Verdict) -> None:
    """End with status 1 where limits are not met, or nothing is decided of them."""
    if not verdict.outcome.good:
        raise SystemExit(int(Exit.LIMITS_NOT_MET))
