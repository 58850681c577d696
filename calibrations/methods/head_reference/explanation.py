"""What the dwells of a head table are traced to: by their settings where these come back, else dwell by dwell."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.head_reference.scene import HeadScene
from tumble.calibrations.methods.head_reference.settings import Settings, angle_numbers, head_settings
from tumble.calibrations.methods.head_reference.steady import unsteady
from tumble.calibrations.methods.head_reference.table import UNITS, HeadTable, head_table, table_of_settings
from tumble.calibrations.methods.head_reference.within import within_settings
from tumble.calibrations.tracing.fitting_noise import best_walk
from tumble.calibrations.tracing.held_out import held_out_rms
from tumble.calibrations.tracing.linear import LinearFit, fit_linear
from tumble.calibrations.tracing.linear_loop import LinearExplained, explain_linear, rms
from tumble.calibrations.tracing.noise import NoiseModel
from tumble.calibrations.tracing.trace import penalised_deviance
from tumble.calibrations.tracing.within import Within

_LOOKS = 5
"""How often a table is traced again once it is known where the head was when the reference was read."""
_MOVED_DEG = 1e-4
"""A change of where the reference saw the head that changes nothing more."""
_PARTS = 10
"""A table is cut into so many parts, each predicted from the others."""


@dataclass(frozen=True, kw_only=True)
class Explanation:
    """What the dwells of one table were traced to: within their settings, and from setting to setting."""

    scene: HeadScene
    """The dwells."""
    settings: Settings
    within: Within | None
    between: LinearExplained[HeadTable]
    """One row for each setting where there are repeats, else one for each dwell."""

    @property
    def error_deg(self) -> FloatArray:
        """Reference minus head, shape (rows,)."""
        return head_table(self.scene).output

    @property
    def settled_deg(self) -> FloatArray:
        """The same free of what was found within the settings, shape (rows,)."""
        return self.error_deg if self.within is None else np.asarray(self.error_deg - self.within.shift)

    @property
    def seen_scene(self) -> HeadScene:
        """The dwells with what is known for certain of how late the reference was read."""
        unrivalled = "latency" in self.between.trace.names and not self.between.close["latency"]
        return replace(self.scene, late_s=_corrected(self.between).late_s if unrivalled else 0.0, short_deg=0.0)

    @property
    def parts(self) -> int:
        """Into how many parts the table is cut, each predicted from the others."""
        return len(self._parts)

    @cached_property
    def residual_deg(self) -> FloatArray:
        """What is left of every dwell, shape (rows,)."""
        left = self.between.best.residual
        if not self.settings.repeated:
            return left
        return np.asarray(left[self.settings.number] + self.settings.within(self.settled_deg))

    @property
    def before_deg(self) -> FloatArray:
        """What a constant leaves of every dwell, shape (rows,)."""
        return np.asarray(self.error_deg - self.error_deg.mean())

    @property
    def found(self) -> int:
        """How many coefficients of effects and shapes were fitted."""
        inside = 0 if self.within is None else len(self.within.explained.best.coefficients)
        return len(self.between.best.coefficients) + inside

    def held_out_constant(self) -> float | None:
        """Root mean square error of predicting parts of the table from the mean of the others; None of one row."""
        output, parts = self.between.table.output, self._parts
        if len(output) < 2 or len(parts) < 2:
            return None
        missed = rms(np.concatenate([output[out] - output[~out].mean() for out in parts]))
        return self._with_repeats(missed, self.error_deg)

    def held_out_found(self) -> float | None:
        """The same with what is found in the others."""
        missed = held_out_rms(self.between.tracer, self.between.trace, self._parts) if len(self._parts) > 1 else None
        return None if missed is None else self._with_repeats(missed, self.settled_deg)

    def _with_repeats(self, missed_deg: float, error_deg: FloatArray) -> float:
        """Error of a dwell, from that of its setting and the scatter of repeats."""
        repeats_deg = rms(self.settings.within(error_deg)) if self.settings.repeated else 0.0
        return float(np.hypot(missed_deg, repeats_deg))

    @property
    def _parts(self) -> Sequence[NDArray[np.bool_]]:
        table = self.between.table
        return _angles(table.scene.angle_deg) if self.settings.repeated else _stretches(table.rows)


def _stretches(rows: int) -> Sequence[NDArray[np.bool_]]:
    """Which dwells are held out together: neighbours, which err alike."""
    number = np.arange(rows) * _PARTS // rows
    return [number == part for part in range(min(_PARTS, rows))]


def _angles(angle_deg: FloatArray) -> Sequence[NDArray[np.bool_]]:
    """Which settings are held out together: whole angles, from both sides."""
    number = angle_numbers(angle_deg) % _PARTS
    return [number == part for part in range(int(number.max(initial=0)) + 1)]


def explain_head(scene: HeadScene, *, asked: bool) -> Explanation:
    """Trace the dwells of a table; where it must be asked about first there is nothing to be found."""
    settings, error_deg = head_settings(scene), head_table(scene).output
    if asked:
        bare = replace(head_table(scene), effects=(), structures=())
        return Explanation(scene=scene, settings=settings, within=None, between=explain_linear(bare, UNITS))
    if not settings.repeated:
        between = explain_steady(head_table(scene))
        return Explanation(scene=between.table.scene, settings=settings, within=None, between=between)
    within = within_settings(scene, settings, error_deg)
    left_deg = error_deg if within is None else np.asarray(error_deg - within.shift)
    between = explain_steady(table_of_settings(scene, settings, left_deg, timed=within is None))
    return Explanation(scene=scene, settings=settings, within=within, between=between)


def explain_steady(table: HeadTable) -> LinearExplained[HeadTable]:
    """Trace a table; again, without waves that do not come back everywhere.

    Neighbours of a stream err alike in ways that its noise knows of; settings beside each other may do so unknown.
    """
    while True:
        explained = _followed(table)
        if table.streamed or not (none := unsteady(explained)):
            return explained
        table = replace(table, effects=tuple(effect for effect in table.effects if effect.name not in none))


def _followed(table: HeadTable) -> LinearExplained[HeadTable]:
    """Trace a table; again, where what was found says that the reference saw the head elsewhere."""
    looks = [explain_linear(table, UNITS)]
    for _ in range(_LOOKS):
        last = looks[-1]
        scene = _corrected(last)
        if np.max(np.abs(scene.seen_deg - last.table.scene.seen_deg)) < _MOVED_DEG:
            break
        looks.append(explain_linear(replace(table, scene=scene), UNITS))
    return min(looks, key=lambda look: penalised_deviance(look.trace))


def _corrected(explained: LinearExplained[HeadTable]) -> HeadScene:
    """The rows with what was found of latency and backlash."""
    scene, names = explained.table.scene, explained.trace.names
    late_s, short_deg = (
        explained.best.quantities(name)[name].value if name in names else 0.0 for name in ("latency", "backlash")
    )
    return replace(scene, late_s=late_s, short_deg=short_deg)


def fit_found(explained: LinearExplained[HeadTable]) -> LinearFit:
    """The best fit with uncertainties that know that neighbouring dwells err alike."""
    noise = _known_noise(explained)
    return fit_linear(explained.table.wandering, replace(explained.trace, noise=noise), UNITS)


def _known_noise(explained: LinearExplained[HeadTable]) -> NoiseModel:
    """The walk that what was found leaves, where it leaves one."""
    table, forms = explained.table.wandering, explained.trace.forms
    if not table.memory.modes.shape[1]:
        return NoiseModel()
    walk, deviance = best_walk(table, forms, NoiseModel())
    return walk if deviance < table.deviance(forms, NoiseModel()) else NoiseModel()
