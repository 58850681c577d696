"""The regression that all alternatives are given: what the declared model leaves, and the catalogue as columns."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.joint import Joint, fit_jointly
from tumble.calibrations.methods.dividing_head.loop.table import dividing_head_table
from tumble.calibrations.methods.dividing_head.model import ALPHA0, BASIS_SIZE, PARAMETERS, coefficients_jacobian
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.tracing.candidates import all_columns, candidates

_ABSORBED = 1e-5
"""A column of which less than this part is left beside the declared model says nothing."""
_SINGULAR = 1e-9
_SAME = 1.0 - 1e-9
"""Two columns with a larger cosine are one; as in the catalogue, the first gives its name."""


@dataclass(frozen=True, kw_only=True)
class Block:
    """The columns of one form of one effect."""

    name: str
    members: NDArray[np.intp]
    coefficients: int
    """How many numbers the form has: columns, and what was scanned for."""


@dataclass(frozen=True, kw_only=True)
class Regression:
    """One table as a linear regression."""

    columns: FloatArray
    """Weighted, without what the declared model absorbs, each of length 1; shape (rows, n)."""
    target: FloatArray
    """Weighted residual of the declared fit with a root mean square of 1; shape (rows,)."""
    blocks: tuple[Block, ...]
    owners: tuple[str, ...]
    """Name of the effect of each column."""
    kept: NDArray[np.intp]
    """Number of each column among those of the `Problem`."""

    def names(self, chosen: NDArray[np.bool_]) -> tuple[str, ...]:
        """Names of the effects of chosen columns, each once."""
        return tuple(dict.fromkeys(owner for owner, wanted in zip(self.owners, chosen, strict=True) if wanted))


@dataclass(frozen=True, kw_only=True)
class Problem:
    """A table fitted with the declared model, and every column of the catalogue beside it."""

    observations: Observations
    tangent: FloatArray
    """Derivatives of the declared model at its fit, weighted, shape (rows, parameters)."""
    columns: FloatArray
    """Weighted, shape (rows, n)."""
    residual: FloatArray
    """Weighted output less the declared fit, shape (rows,)."""
    forms: tuple[tuple[str, int, int], ...]
    """Of each form its effect, its coefficients and its columns, in their order."""

    def regression(self, rows: NDArray[np.bool_] | None = None) -> Regression:
        """Return the regression of all rows, or of some.

        The six declared parameters are in every model and never penalised: their tangent columns at the declared fit
        are taken out of target and candidates alike, which leaves every coefficient as it would be with them (Frisch,
        Waugh).
        """
        used = np.ones(len(self.residual), dtype=bool) if rows is None else rows
        absorbed, columns = _orthonormal(self.tangent[used]), self.columns[used]
        free = _beside(absorbed, columns)
        length = np.linalg.norm(free, axis=0)
        kept = np.flatnonzero(length > _ABSORBED * np.linalg.norm(columns, axis=0))
        kept = kept[_first_of_its_kind(free[:, kept] / length[kept])]
        target = _beside(absorbed, self.residual[used])
        owner = np.repeat(np.arange(len(self.forms)), [width for _, _, width in self.forms])[kept]
        blocks = [
            Block(name=name, members=np.flatnonzero(owner == number), coefficients=coefficients)
            for number, (name, coefficients, _) in enumerate(self.forms)
        ]
        return Regression(
            columns=free[:, kept] / length[kept],
            target=target / np.sqrt(np.mean(target**2)),
            blocks=tuple(block for block in blocks if len(block.members)),
            owners=tuple(self.forms[number][0] for number in owner),
            kept=kept,
        )

    def errors(self, out: NDArray[np.bool_], chosen: NDArray[np.intp]) -> FloatArray:
        """Weighted output of rows that are held out less what the others predict with some columns."""
        whole = np.column_stack([self.tangent, self.columns[:, chosen]])
        length = np.linalg.norm(whole[~out], axis=0)
        seen = whole[:, length > 0.0] / length[length > 0.0]
        fitted, *_ = np.linalg.lstsq(seen[~out], self.residual[~out], rcond=_SINGULAR)
        return np.asarray(self.residual[out] - seen[out] @ fitted)


def problem(observations: Observations) -> Problem:
    """Fit a table with the declared model, and lay out the catalogue beside it."""
    joint = fit_jointly(observations)
    base = dividing_head_table(joint, CATALOGUE)
    offered = candidates(replace(base, structures=()))
    root = np.sqrt(joint.weights)
    return Problem(
        observations=joint.observations,
        tangent=_tangent(joint) * root[:, None],
        columns=all_columns(offered, len(root)) * root[:, None],
        residual=joint.residual_v * root,
        forms=tuple((one.effect.name, one.coefficients, one.form.columns.shape[1]) for one in offered),
    )


def _tangent(joint: Joint) -> FloatArray:
    """Derivatives of the declared model at its fit; without alpha0 where that is held."""
    jacobian = coefficients_jacobian(joint.fit.theta[: len(PARAMETERS)])
    tangent = joint.basis[:, :BASIS_SIZE] @ jacobian
    return tangent if joint.fit.alpha0_fitted else np.delete(tangent, ALPHA0, axis=1)


def _orthonormal(columns: FloatArray) -> FloatArray:
    length = np.linalg.norm(columns, axis=0)
    seen = length > 1e-9 * length.max()
    left, values, _ = np.linalg.svd(columns[:, seen] / length[seen], full_matrices=False)
    return np.asarray(left[:, values > 1e-9 * values[0]])


def _beside(span: FloatArray, columns: FloatArray) -> FloatArray:
    return np.asarray(columns - span @ (span.T @ columns))


def _first_of_its_kind(columns: FloatArray) -> NDArray[np.bool_]:
    """Which columns of length 1 are no copy, up to the sign, of an earlier one."""
    cosines = np.triu(np.abs(columns.T @ columns), 1)
    return np.asarray(cosines.max(axis=0, initial=0.0) < _SAME)
