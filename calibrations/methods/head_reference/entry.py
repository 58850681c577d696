"""A head held against a reference, as the store takes it."""

from tumble.calibrations.core.verdict import Model, Verdict
from tumble.calibrations.methods.head_reference.document import document
from tumble.calibrations.methods.head_reference.loop import ReferenceLoop
from tumble.calibrations.records.entry import Entry

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
