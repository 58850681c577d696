"""Heading and drift in the noise that is declared of the gyro, beside what was found: at the Cramér-Rao bound.

Columns of the table declare N, B, K or a Gauss-Markov process; a programme declares them for its run. What was found
is fitted with heading and drift anew, so that its own uncertainty is in theirs; what was scanned for stays.
"""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from typing import Any, Final

import numpy as np
from scipy.special import chdtr, chdtrc

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.methods.gyrocompass.declaration import CORRELATION, dwell_times
from tumble.calibrations.methods.gyrocompass.expected import DriftNoise
from tumble.calibrations.methods.gyrocompass.fit import GyrocompassFit
from tumble.calibrations.methods.gyrocompass.heading import estimated
from tumble.calibrations.methods.gyrocompass.model import NAMES, UNITS
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations
from tumble.calibrations.methods.gyrocompass.table import GyrocompassTable

_CONTRADICTED_P: Final = 0.001
"""Below this the rates scatter otherwise than the noise that is declared."""


@dataclass(frozen=True, kw_only=True)
class InDeclaredNoise:
    """What rates say if the gyro is as declared."""

    noise: DriftNoise
    values: Mapping[str, float]
    """α0 in degrees and the drift in °/h."""
    standard_uncertainties: Mapping[str, float]
    """By the noise alone, without the stand."""
    chi_square: float
    degrees_of_freedom: int

    @property
    def p_value(self) -> float:
        """Chance that rates scatter as far from what is declared, to either side."""
        tails = (chdtr(self.degrees_of_freedom, self.chi_square), chdtrc(self.degrees_of_freedom, self.chi_square))
        return float(min(1.0, 2.0 * min(tails)))

    @property
    def contradicted(self) -> bool:
        """Whether the rates are not those of such a gyro."""
        return self.degrees_of_freedom > 0 and self.p_value < _CONTRADICTED_P

    @property
    def scatter_ratio(self) -> float:
        """Scatter of the rates over that which is declared."""
        return float(np.sqrt(self.chi_square / max(self.degrees_of_freedom, 1)))

    @property
    def told(self) -> Mapping[str, float]:
        """What is declared of the gyro, without what is 0."""
        sizes = {name: size for name, size in asdict(self.noise).items() if size}
        return sizes if self.noise.gauss_markov_deg_h else {k: v for k, v in sizes.items() if k != CORRELATION}

    def as_json(self) -> dict[str, Any]:
        """As a result has it."""
        stated = {
            name: {
                "value": self.values[name],
                "standard_uncertainty": self.standard_uncertainties[name],
                "unit": UNITS[name],
            }
            for name in NAMES
        }
        return {
            "noise": dict(self.told),
            **stated,
            "chi_square": self.chi_square,
            "degrees_of_freedom": self.degrees_of_freedom,
            "p_value": self.p_value,
            "contradicted": self.contradicted,
        }


def in_declared_noise(
    table: GyrocompassTable, fit: GyrocompassFit, parameters: Mapping[str, Parameter]
) -> InDeclaredNoise | None:
    """Heading and drift in the noise that a table declares; None where it declares none, or they are withheld."""
    rows = table.observations
    noise, times_s = declared(rows), dwell_times(rows)
    if noise is None or times_s is None or any(each.value is None for each in parameters.values()):
        return None
    found = [item.form.columns[table.rates] for item in fit.found]
    beside = np.column_stack([np.empty((len(rows), 0)), *found])
    heading = estimated(
        rows.rate_deg_h,
        np.deg2rad(rows.azimuth_deg),
        rows.latitude_deg,
        table.scene.lean,
        noise.covariance(*times_s),
        beside,
    )
    return InDeclaredNoise(
        noise=noise,
        values=dict(zip(NAMES, (float(heading.alpha0_deg), float(heading.drift_deg_h)), strict=True)),
        standard_uncertainties=dict(zip(NAMES, heading.standard_uncertainties.tolist(), strict=True)),
        chi_square=float(heading.chi_square),
        degrees_of_freedom=len(rows) - len(NAMES) - int(np.linalg.matrix_rank(beside)),
    )


def declared(rows: GyrocompassObservations) -> DriftNoise | None:
    """How the rate of the gyro wanders as a table declares it; None where nothing above 0 is declared."""
    columns = {each.name: getattr(rows, each.name) for each in fields(DriftNoise)}
    told = {name: values[values > 0.0] for name, values in columns.items() if values is not None}
    sizes = {name: float(values[0]) for name, values in told.items() if len(values)}
    return DriftNoise(**sizes) if sizes.keys() - {CORRELATION} else None
