"""Stand records from a head that was measured against a reference."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from tumble.app.identity import program_identity
from tumble.app.measurements import Measurement, read_measurement
from tumble.app.stand_records import identity_of
from tumble.calibrations.methods.head_reference.head_map import ReferenceRun, reference_run
from tumble.calibrations.methods.head_reference.loop import close_reference_loop
from tumble.calibrations.methods.head_reference.observations import read_head_table
from tumble.calibrations.records.raw import stored_path
from tumble.calibrations.stand_records.record import Contribution, StandRecord, Status, Validity
from tumble.procedures.errors import InputError

REFERENCE = "reference"
"""What stands for the serial number of a unit."""


def is_reference(measurement: Measurement) -> bool:
    """Whether a file is a table of head and reference."""
    return measurement.observations.voltage_v is None and measurement.observations.reference_deg is not None


def run_of_reference(measurement: Measurement) -> ReferenceRun | None:
    """What such a table says of the stand; None where it shows no error of the circle."""
    return reference_run(close_reference_loop(read_head_table(measurement.path)))


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
    measurement = read_measurement(path, stand)
    identity, run = identity_of(measurement), run_of_reference(measurement)
    if identity is None or run is None:
        raise InputError(
            f"{path}: shows no error of the circle or backlash; there is nothing to put into a stand record"
        )
    said = Contribution(
        serial_number=REFERENCE,
        raw_paths=(stored_path(folder, path),),
        raw_sha256=(measurement.sha256,),
        measured_at="",
        stand=measurement.stand,
        coefficients=tuple(run.whole.values.tolist()),
        standard_uncertainties=tuple((run.whole.covariance.diagonal() ** 0.5).tolist()),
    )
    angle_deg = measurement.observations.angle_deg
    from tumble.calibrations.stand_records.store import StandRecords

    return StandRecords(folder).add(
        identity=identity,
        status=Status.IN_FORCE,
        corrections=run.whole,
        contributions=(said,),
        agreement_p=None,
        validity=Validity(angle_deg=(float(angle_deg.min()), float(angle_deg.max()))),
        program_version=program_identity().version,
    )
