"""Coverage factors (GUM, annex G)."""


def coverage_factor(freedom: float, probability: float = 0.95) -> float:
    """Two-sided Student factor k for a coverage probability (GUM, G.3); `freedom` may be infinite.

    Infinite where there are no degrees of freedom.
    """
    from scipy.special import stdtrit  # takes a tenth of a second, in which a window is half up

    if freedom <= 0:
        return float("inf")
    return float(stdtrit(min(freedom, 1e9), 0.5 + probability / 2))
