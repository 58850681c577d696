"""A closed loop on vibrated dwells, as the store takes it."""

from typing import Final

from tumble.calibrations.core.verdict import Model, Verdict
from tumble.calibrations.methods.vibration.document import NAME, document
from tumble.calibrations.methods.vibration.loop import VibrationLoop
from tumble.calibrations.records.entry import Entry

VERSION: Final = 1


def entry(loop: VibrationLoop) -> Entry:
    """A closed loop to be recorded."""
    result = document(loop)
    return Entry(
        method=NAME,
        method_version=VERSION,
        result=result,
        parameters=result["declared"]["parameters"],
        augmented=result["augmented"]["parameters"],
        verdict=Verdict(judged=Model.AUGMENTED if loop.effects else Model.DECLARED, parameters=()),
    )
