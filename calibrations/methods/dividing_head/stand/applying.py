"""Applies a stand record to a later run."""

from dataclasses import replace

from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.methods.dividing_head.joint import fit_jointly
from tumble.calibrations.methods.dividing_head.loop.table import scene_of
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.stand.columns import corrections_voltage_v
from tumble.calibrations.stand_records.record import StandRecord


@one_blas_thread
def corrected(observations: Observations, record: StandRecord) -> Observations:
    """Rows as they would be on a stand without these errors.

    Angles gain the error of the head, by the direction of each move; the angle as reported stays beside it. Voltages
    lose what the tilt of the axis and the voltmeter add; how much a tilt adds is taken from a fit of the rows.

    Raises
    ------
    ValueError
        No voltage, or no usable row.
    """
    corrections, head_map = record.corrections, record.corrections.head_map
    if head_map is not None:
        error_deg = head_map.error_deg(observations.angle_deg, _seen(observations).direction)
        observations = replace(observations, correction_deg=error_deg)
    if all(term.of_angle for term in corrections.terms):
        return observations
    nearly = replace(
        observations, voltage_v=observations.output_v - corrections_voltage_v(corrections, _seen(observations))
    )
    return replace(observations, voltage_v=observations.output_v - corrections_voltage_v(corrections, _seen(nearly)))


def _seen(observations: Observations) -> Scene:
    return scene_of(observations, fit_jointly(observations).fit.theta)
