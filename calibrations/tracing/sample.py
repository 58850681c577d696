"""Rows ready for comparison: weighted, and turned so that autocorrelated noise is confined to the first of them."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.declared import Declared
from tumble.calibrations.tracing.noise import Memory, NoiseModel
from tumble.calibrations.tracing.whitened import WhitenedFit


@dataclass(frozen=True, kw_only=True)
class Sample:
    """Some or all rows of a table, with the declared model."""

    declared: Declared
    """Its functions weighted and turned."""
    output: FloatArray
    """Weighted and turned, shape (turned rows,)."""
    memory: Memory
    root_weights: FloatArray
    """Shape (rows,)."""
    _whitened_fits: dict[NoiseModel, WhitenedFit] = field(default_factory=dict, repr=False, compare=False)

    def turned(self, columns: FloatArray) -> FloatArray:
        """Weigh and turn columns, shape (rows, n)."""
        return self.memory.turned(columns * self.root_weights[:, None])

    def whitened_fit(self, noise: NoiseModel) -> WhitenedFit:
        """The declared model in a kind of noise."""
        if noise not in self._whitened_fits:
            white, rows = self.memory.whitening(noise), len(self.root_weights)
            self._whitened_fits[noise] = WhitenedFit(self.declared, self.output, white, rows)
        return self._whitened_fits[noise]

    def deviance_by_noise(self, columns: FloatArray) -> Callable[[NoiseModel], float]:
        """-2 ln L with further columns, shape (rows, n), as a function of the noise, up to a constant of the table.

        Beside the directions of the memory no noise changes anything, so that the rows there are compressed first.
        """
        size, functions = self.memory.size, self.declared.functions.shape[1]
        together = np.column_stack([self.declared.functions, self.turned(columns), self.output])
        short = np.concatenate([together[:size], np.linalg.qr(together[size:], mode="r")])
        sample = replace(
            self, declared=self.declared.with_functions(short[:, :functions]), output=short[:, -1], _whitened_fits={}
        )

        def deviance(noise: NoiseModel) -> float:
            whitened_fit = sample.whitened_fit(noise)
            return whitened_fit.deviance(whitened_fit.fit(whitened_fit.split(short[:, functions:-1])))

        return deviance


def sample(declared: Declared, output_v: FloatArray, weights: FloatArray, memory: Memory) -> Sample:
    """Weigh and turn rows.

    Parameters
    ----------
    declared
        The declared model, its functions as they are.
    output_v, weights
        Shape (rows,), in volts and relative.
    memory
        Of the weighted rows.
    """
    root = np.sqrt(weights)
    turned = memory.turned(np.column_stack([declared.functions, output_v]) * root[:, None])
    return Sample(
        declared=declared.with_functions(turned[:, :-1]), output=turned[:, -1], memory=memory, root_weights=root
    )
