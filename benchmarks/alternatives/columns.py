"""The regression that all alternatives are given: what the declared model leaves, and the catalogue as columns."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.joint import Joint
from tumble.calibrations.methods.dividing_head.loop.table import dividing_head_table
from tumble.calibrations.methods.dividing_head.model import ALPHA0, BASIS_SIZE, PARAMETERS, coefficients_jacobian
from tumble.calibrations.tracing.candidates import all_columns, candidates

_ABSORBED = 1e-5
"""A column of which less than this part is left beside the declared model says nothing."""
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

    def names(self, chosen: NDArray[np.bool_]) -> tuple[str, ...]:
        """Names of the effects of chosen columns, each once."""
        return tuple(dict.fromkeys(owner for owner, wanted in zip(self.owners, chosen, strict=True) if wanted))


def regression(joint: Joint) -> Regression:
    """Return the regression of a table fitted with the declared model.

    The six declared parameters are in every model and never penalised: their tangent columns at the declared fit are
    taken out of target and candidates alike, which leaves every coefficient as it would be with them (Frisch, Waugh).
    """
    base = dividing_head_table(joint, CATALOGUE)
    offered = candidates(replace(base, structures=()))
    owner = np.repeat(np.arange(len(offered)), [one.form.columns.shape[1] for one in offered])
    root = np.sqrt(joint.weights)
    absorbed = _orthonormal(_tangent(joint) * root[:, None])
    columns = all_columns(offered, len(root)) * root[:, None]
    free = _beside(absorbed, columns)
    length = np.linalg.norm(free, axis=0)
    kept = np.flatnonzero(length > _ABSORBED * np.linalg.norm(columns, axis=0))
    kept = kept[_first_of_its_kind(free[:, kept] / length[kept])]
    target = _beside(absorbed, joint.residual_v * root)
    blocks = [
        Block(name=one.effect.name, members=np.flatnonzero(owner[kept] == number), coefficients=one.coefficients)
        for number, one in enumerate(offered)
    ]
    return Regression(
        columns=free[:, kept] / length[kept],
        target=target / np.sqrt(np.mean(target**2)),
        blocks=tuple(block for block in blocks if len(block.members)),
        owners=tuple(offered[number].effect.name for number in owner[kept]),
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
