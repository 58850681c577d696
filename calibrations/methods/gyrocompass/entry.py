"""A closed loop on a gyrocompass, as the store takes it."""

from tumble.calibrations.core.verdict import Model, Verdict
from tumble.calibrations.methods.gyrocompass.document import document
from tumble.calibrations.methods.gyrocompass.loop import GyrocompassLoop
from tumble.calibrations.records.entry import Entry

VERSION = 1


def entry(loop: GyrocompassLoop) -> Entry:
    """A closed loop to be recorded."""
    result = document(loop)
    return Entry(
        method="gyrocompass",
        method_version=VERSION,
        result=result,
        parameters=result["declared"]["parameters"],
        augmented=result["augmented"]["parameters"],
        verdict=Verdict(judged=Model.AUGMENTED if loop.effects else Model.DECLARED, parameters=()),
    )
