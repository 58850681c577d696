"""Sequentially thresholded least squares of PySINDy on the algebraic relation."""

import warnings

import numpy as np
from numpy.typing import NDArray
from pysindy.optimizers import STLSQ
from sklearn.model_selection import KFold, cross_val_score

from benchmarks.alternatives.columns import Regression

THRESHOLDS = np.geomspace(0.5, 64.0, 15)
"""Smallest coefficients to try, in root mean squares of the residual: the largest keeps nothing but gross structure."""


def sindy(regression: Regression) -> NDArray[np.bool_]:
    """Which columns the optimiser keeps.

    The optimiser's own ridge (0.05) and unbiasing are left as they are; its threshold is chosen by cross-validation, as
    PySINDy's documentation does ("Working with Scikit-learn"). The columns are normalised already.
    """
    folds = KFold(5, shuffle=True, random_state=0)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        scores = [_score(threshold, regression, folds) for threshold in THRESHOLDS]
        fit = STLSQ(threshold=THRESHOLDS[int(np.argmax(scores))]).fit(regression.columns, regression.target)
    return np.asarray(np.ravel(fit.coef_) != 0.0)


def _score(threshold: float, regression: Regression, folds: KFold) -> float:
    """Mean part of the variance that is predicted in the rows that were left out."""
    return float(np.mean(cross_val_score(STLSQ(threshold=threshold), regression.columns, regression.target, cv=folds)))
