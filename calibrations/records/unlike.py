"""What two records do not have in common beside their values, so that nobody compares what is not alike unawares."""

from collections.abc import Iterator

from tumble.calibrations.core.provenance import Provenance
from tumble.calibrations.records.record import Record
from tumble.messages import AsWritten, Message


def unlike(first: Record, second: Record) -> tuple[Message, ...]:
    """A sentence for unit, lot, programme, stand and version of the method, each where it is not the same in both."""
    return tuple(_sentences(first, second))


def _sentences(first: Record, second: Record) -> Iterator[Message]:
    a, b = first.provenance, second.provenance
    if a.serial_number != b.serial_number:
        yield Message("They are of two units: {first}, {second}.", **_both(a.serial_number, b.serial_number))
    if a.lot and b.lot and a.lot != b.lot:
        yield Message("They are of two lots: {first}, {second}.", **_both(a.lot, b.lot))
    elif a.lot != b.lot:
        yield Message("Only one of them names a lot: {lot}.", lot=AsWritten(a.lot or b.lot))
    yield from _programmes(a, b)
    yield from _stands(a, b)
    if first.method_version != second.method_version:
        versions = _both(str(first.method_version), str(second.method_version))
        yield Message("They are of two versions of the method: {first}, {second}.", **versions)


def _programmes(a: Provenance, b: Provenance) -> Iterator[Message]:
    if a.programme_name != b.programme_name:
        yield Message("They are of two programmes: {first}, {second}.", **_both(a.programme_name, b.programme_name))
    elif a.programme_sha256 != b.programme_sha256:
        changed = AsWritten(a.programme_name)
        yield Message("The programme {name} is not the same file in both.", name=changed)


def _stands(a: Provenance, b: Provenance) -> Iterator[Message]:
    if a.is_simulated != b.is_simulated:
        yield Message("Only one of them was measured at a simulated stand.")
    if a.stand_name != b.stand_name:
        yield Message("They are of two stands: {first}, {second}.", **_both(a.stand_name, b.stand_name))
    elif a.stand != b.stand:
        yield Message("The stand {name} is not described alike in both.", name=AsWritten(a.stand_name))


def _both(first: str, second: str) -> dict[str, AsWritten]:
    """Of what has no name there is a dash."""
    return {"first": AsWritten(first or "—"), "second": AsWritten(second or "—")}
