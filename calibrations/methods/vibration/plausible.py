"""What is asked of a table of dwells that is not what any unit does; it is taken as it is."""

from dataclasses import replace
from typing import Final

from tumble.calibrations.core.repeats import pure_error
from tumble.calibrations.methods.vibration.observations import VibrationObservations
from tumble.calibrations.methods.vibration.table import VibrationTable, settings
from tumble.messages import Message

_LEAST_UG: Final = 0.05
"""To less no accelerometer under vibration repeats the mean of a dwell; of 3 µg in mg it is 0.003."""
_FEWEST: Final = 4
"""Degrees of freedom by which a scatter is known."""


def with_questions(table: VibrationTable) -> VibrationObservations:
    """The rows of a table with what is asked of them among their warnings."""
    rows = table.observations
    repeats = pure_error(table.output, settings(table.scene), table.weights)
    if repeats.degrees_of_freedom < _FEWEST or repeats.standard_deviation >= _LEAST_UG:
        return rows
    sentence = Message(
        "output_ug repeats to {scatter:.2g} µg, which no accelerometer does; is it in mg, or in g? All "
        "coefficients are in its unit",
        scatter=repeats.standard_deviation,
    )
    return replace(rows, warnings=(*rows.warnings, sentence))
