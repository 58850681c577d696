"""A head held against a reference, as the store takes it."""

from tumble.calibrations.records.entry import Entry
from tumble.calibrations.reference.document import document
from tumble.calibrations.reference.loop import ReferenceLoop
from tumble.calibrations.verdict import Model, Verdict

VERSION = 1


def entry(loop: ReferenceLoop) -> Entry:
    """A closed loop to be recorded; no programme limits its parameters."""
    result = document(loop)
    found = loop.effects or loop.unexplained
    return Entry(
        method=result["method"],
        method_version=VERSION,
        result=result,
        parameters=result["declared"]["parameters"],
        augmented=result["augmented"]["parameters"],
        verdict=Verdict(judged=Model.AUGMENTED if found else Model.DECLARED, parameters=()),
    )
