"""Which kind of table a header is of; a table of no kind that is known is refused by name, with what is there."""

import difflib
from collections.abc import Sequence
from enum import Enum
from pathlib import Path
from typing import Final

from tumble.calibrations.core.cells import TableError
from tumble.calibrations.core.files import read_header, read_lines
from tumble.calibrations.core.sentences import series
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.temperature.columns import Column, holds_numbers, named, says_runs

READ: Final = (
    "an accelerometer on a head (angle_deg, voltage_V), a head against a reference (angle_deg, reference_deg), or "
    "parameters against temperature (…_degC, and each parameter with its unit, as bias_mV)"
)
"""The tables that are read, in words."""


class Kind(Enum):
    """What a table is of."""

    ACCELEROMETER = "accelerometer"
    HEAD = "head"
    RUNS = "temperature"


_FOREIGN: Final[tuple[tuple[str, tuple[str, ...]], ...]] = (
    ("a triad on a two-axis stand", ("outer_deg", "inner_deg")),
    ("a triad of accelerometers", ("u_x_V", "u_y_V", "u_z_V")),
    ("a triad of accelerometers", ("u_x_counts", "u_y_counts", "u_z_counts")),
    ("gyrocompassing in several azimuths", ("rate_deg_h", "azimuth_deg")),
    ("a gyro", ("rate_deg_h",)),
    ("a gyro", ("rate_deg_s",)),
    ("vibration rectification", ("output_ug", "ai_g")),
    ("vibrated dwells", ("drive_Hz", "output_g")),
    ("vibration", ("output_ug",)),
    ("Allan deviations", ("tau_s",)),
)
"""Tables that have a name and are not analysed, by columns that show them."""
_SIGNALS: Final[tuple[tuple[str, tuple[str, ...]], ...]] = (
    ("Allan deviations", ("adev", "oadev", "mdev", "hdev", "allan", "avar")),
    ("a triad", ("acc_x", "accel_x", "acceleration_x")),
    ("a gyro", ("gyr_x", "omega_x", "gyro_x", "rate_x")),
    ("the climate of a room", ("humidity", "rh_", "pressure", "dew")),
)
"""The same by parts of names."""
_NEAR: Final = 0.7
"""A name so like a known one is a slip of the pen."""


def kind_of(path: Path) -> Kind:
    """Kind of a table by its header.

    Raises
    ------
    TableError
        Unreadable, or of no kind that is read: what it looks like or what its columns are, and what is read.
    """
    if kind := _measured(read_header(path)):
        return kind
    header, lines = read_lines(path)  # a malformed table is told of as such
    if kind := _measured(header):
        return kind
    if foreign := _foreign(header):
        raise TableError(
            f"{path}, line 1: this looks like a table of {foreign}, which this version does not analyse; "
            f"tumble reads {READ}"
        )
    numbers = [name for place, name in enumerate(header) if holds_numbers(place, lines)]
    if "angle_deg" not in header and says_runs(numbers):
        return Kind.RUNS
    raise TableError(f"{path}, line 1: {_unknown(header, numbers)}")


def _measured(header: Sequence[str]) -> Kind | None:
    """Kind of a table of something on a head; None for any other."""
    if "angle_deg" not in header:
        return None
    if "voltage_V" in header:
        return Kind.ACCELEROMETER
    return Kind.HEAD if "reference_deg" in header else None


def _foreign(header: Sequence[str]) -> str:
    """What a table of another kind is of; empty where nothing shows it."""
    for what, columns in _FOREIGN:
        if all(column in header for column in columns):
            return f"{what} ({series(columns)})"
    for what, parts in _SIGNALS:
        if shown := [name for name in header if any(name.lower().startswith(part) for part in parts)]:
            return f"{what} ({series(shown)})"
    return ""


def _unknown(header: Sequence[str], numbers: Sequence[str]) -> str:
    """What is wrong with a header of no kind, and what to do."""
    seen = f"the columns are {', '.join(header)}"
    missing = "angle_deg" if "angle_deg" not in header else "voltage_V (or reference_deg)"
    if near := _near(header):
        asked = series([f"{given} {known}" for given, known in near.items()])
        return f"column {missing} is missing; is {asked}? Rename and check the unit; {seen}"
    unsaid = named(numbers, Column.UNKNOWN)
    if named(numbers, Column.TEMPERATURE) and unsaid:
        many = len(unsaid) > 1
        return (
            f"not a table that tumble knows: column{'s' * many} {series(unsaid)} {'say' if many else 'says'} no "
            f"parameter of a sensor with its unit; {seen}; tumble reads {READ}"
        )
    if named(numbers, Column.PARAMETER) and not named(numbers, Column.TEMPERATURE):
        return f"column angle_deg, or a temperature in °C (…_degC) is missing; {seen}; tumble reads {READ}"
    return f"not a table that tumble knows: column {missing} is missing; {seen}; tumble reads {READ}"


def _near(header: Sequence[str]) -> dict[str, str]:
    """Columns that are misspelt, and how they are spelt."""
    lowered = {name.lower(): name for name in header if name not in Observations.spelt()}
    wanted = [known for known in ("angle_deg", "reference_deg", "voltage_V") if known not in header]
    close = {known: difflib.get_close_matches(known.lower(), lowered, n=1, cutoff=_NEAR) for known in wanted}
    return {lowered[names[0]]: known for known, names in close.items() if names}
