"""95% intervals of a proportion."""

import math

from scipy.special import betaincinv

_Z = 1.959963984540054


def wilson(successes: int, trials: int) -> tuple[float, float]:
    """Wilson's score interval (Wilson 1927); from 0 to 1 without trials."""
    if not trials:
        return 0.0, 1.0
    part, spread = successes / trials, _Z**2 / trials
    centre = part + spread / 2.0
    half = _Z * math.sqrt(part * (1.0 - part) / trials + spread / (4.0 * trials))
    return max((centre - half) / (1.0 + spread), 0.0), min((centre + half) / (1.0 + spread), 1.0)


def clopper_pearson_upper(successes: int, trials: int) -> float:
    """Upper end of the two-sided interval of Clopper and Pearson (1934)."""
    if successes >= trials:
        return 1.0
    return float(betaincinv(successes + 1.0, float(trials - successes), 0.975))


def percent(part: int, whole: int) -> str:
    """A part in percent; a dash where there is no whole."""
    return f"{100.0 * part / whole:.2f} %" if whole else "–"
