"""A triad as a table that may be traced: all channels at once, each with its weight."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import compress
from tumble.calibrations.core.repeats import labels, visits
from tumble.calibrations.methods.triad.effects import TRIAD_EFFECTS
from tumble.calibrations.methods.triad.effects.unnamed import unnamed
from tumble.calibrations.methods.triad.geometry import directions
from tumble.calibrations.methods.triad.model import Triad, functions
from tumble.calibrations.methods.triad.observations import TriadObservations
from tumble.calibrations.methods.triad.scene import TriadScene
from tumble.calibrations.methods.triad.weights import channel_weights
from tumble.calibrations.tracing.components import Axis
from tumble.calibrations.tracing.effect import Variable
from tumble.calibrations.tracing.noise import Memory, scaled_levels
from tumble.calibrations.tracing.table import Extensible, View


@dataclass(frozen=True, kw_only=True)
class TriadTable(Extensible):
    """The table of a triad; rows are those of channels x, y, z of each dwell in turn, the output in volts."""

    scene: TriadScene

    @property
    def observations(self) -> TriadObservations:
        """The dwells in use."""
        return self.scene.observations

    def view(self, rows: TriadObservations, theta: FloatArray) -> TriadScene:
        """Dwells as effects see them with these parameters."""
        return TriadScene(
            observations=rows,
            theta=theta[: len(self.scene.theta)],
            reference_temperature_degc=self.scene.reference_temperature_degc,
        )

    def functions(self, view: View) -> FloatArray:
        """The thirty functions of the positions, shape (rows, 30)."""
        assert isinstance(view, TriadScene), "it is a view of this table"
        return functions(view.directions)

    def axes_in(self, view: View) -> tuple[Axis, ...]:
        """Channels, each with every variable that varies in the view."""
        assert isinstance(view, TriadScene), "it is a view of this table"
        return unnamed(view)

    @property
    def further_weights(self) -> FloatArray:
        """Those of a further dwell, one for each channel."""
        return self.weights[:3]

    def blocks(self, variable: Variable) -> NDArray[np.int64]:
        """Positions of each channel; dwells for time; realisations; visits of a temperature."""
        if variable in ("time", "order"):
            return np.repeat(np.arange(self.scene.dwells), 3)
        if variable == "realisation":
            return np.repeat(self.scene.realisation, 3)
        if variable == "temperature" and self.scene.temperature_k is not None:
            return np.repeat(visits(self.scene.temperature_k.mean(axis=1), self.scene.realisation), 3)
        return labels(np.repeat(self.observations.positions, 3), np.tile(np.arange(3), self.scene.dwells))


def triad_table(observations: TriadObservations, reference_temperature_degc: float = 23.0) -> TriadTable:
    """Prepare a table: fitted with the declared model, from whose parameters effects are seen."""
    weights = np.tile(channel_weights(observations), len(observations))
    model = Triad(functions=functions(directions(observations.outer_deg, observations.inner_deg)))
    output_v = observations.outputs_v.ravel()
    theta = model.fitted(compress(model.functions, output_v, weights))
    scene = TriadScene(observations=observations, theta=theta, reference_temperature_degc=reference_temperature_degc)
    drawn = {each.name: forms[0].columns for each in TRIAD_EFFECTS if each.random and (forms := each.forms(scene))}
    return TriadTable(
        model=model,
        output=output_v,
        unit="V",
        weights=weights,
        scene=scene,
        effects=TRIAD_EFFECTS,
        structures=(),
        axes=unnamed(scene),
        memory=Memory(
            modes=np.empty((len(output_v), 0)),
            levels={name: scaled_levels(columns, weights) for name, columns in drawn.items()},
        ),
    )
