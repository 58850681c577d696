"""Stand records from tables that need no unit to agree: a head that was measured against a reference.

A method whose tables say so much registers, in the entry point group `tumble.references`, a function from a table's
path to a `ReferenceRun`.
"""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, Final, Protocol, TypeAlias

from tumble import plugins
from tumble.app.identity import program_identity
from tumble.app.methods import methods
from tumble.app.stand_records import identity_of_stand
from tumble.calibrations.core.cells import TableError
from tumble.calibrations.core.files import read_header
from tumble.calibrations.core.known_tables import reader
from tumble.calibrations.records.raw import file_sha256, stored_path
from tumble.calibrations.stand_records.corrections import Corrections
from tumble.calibrations.stand_records.record import Contribution, StandRecord, Status, Validity
from tumble.calibrations.stand_records.terms import Term
from tumble.messages import Message
from tumble.procedures.errors import InputError

REFERENCE: Final = "reference"
"""What stands for the serial number of a unit."""
_GROUP: Final = "tumble.references"


class ReferenceRun(Protocol):
    """What a table says of its stand, on its own word."""

    @property
    def whole(self) -> Corrections:
        """All that it says."""
        ...

    @property
    def validity(self) -> Validity:
        """Over what it was measured."""
        ...

    def estimate(self, terms: Sequence[Term]) -> Corrections:
        """What it says of these terms."""
        ...


_RunOf: TypeAlias = Callable[[Path], ReferenceRun | None]


def is_reference(path: Path) -> bool:
    """Whether a file is a table that gives a stand record by itself."""
    return _reader(path) is not None


def run_of_reference(path: Path) -> ReferenceRun | None:
    """What such a table says of the stand; None where it shows nothing. Raises `InputError`."""
    name = _reader(path)
    if name is None:
        return None
    try:
        run_of: _RunOf = plugins.load(_GROUP, name)
        return run_of(path)
    except (TableError, ValueError) as error:
        raise InputError(str(error)) from error


def learn_from_reference(path: Path, stand: Mapping[str, Any], folder: Path) -> StandRecord:
    """Put the head map of a table of head and reference in force for a stand.

    Parameters
    ----------
    path
        The table.
    stand
        Stand file as data.
    folder
        Store.

    Raises
    ------
    InputError
        The table shows no error of the circle.
    StoreError
        The store cannot be read or written.
    """
    identity, run = identity_of_stand(stand, {}), run_of_reference(path)
    if identity is None or run is None:
        raise InputError(
            Message(
                "{path}: shows no error of the circle or backlash; there is nothing to put into a stand record",
                path=path,
            )
        )
    said = Contribution(
        serial_number=REFERENCE,
        raw_paths=(stored_path(folder, path),),
        raw_sha256=(file_sha256(path),),
        measured_at="",
        stand=stand,
        coefficients=tuple(run.whole.values.tolist()),
        standard_uncertainties=tuple((run.whole.covariance.diagonal() ** 0.5).tolist()),
    )
    from tumble.calibrations.stand_records.store import StandRecords

    return StandRecords(folder).add(
        identity=identity,
        status=Status.IN_FORCE,
        corrections=run.whole,
        contributions=(said,),
        agreement_p=None,
        validity=run.validity,
        program_version=program_identity().version,
    )


def _reader(path: Path) -> str | None:
    """The method that reads a table and says what it tells of the stand; None for any other file."""
    known = plugins.names(_GROUP)
    method = reader((each for each in methods() if each.name in known), read_header(path))
    return method.name if method else None
