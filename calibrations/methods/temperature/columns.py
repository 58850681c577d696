"""What the columns of a table of runs say that they are, by their names: `bias_x_arcsec` is a parameter, `time_h` none.

A name is the quantity, then its unit. Only what says both is taken for a parameter of a sensor.
"""

import re
from collections.abc import Sequence
from enum import Enum
from typing import Final

_UNITS: Final = (
    *("V_per_g", "mV_per_g", "uV_per_g", "V_g", "mV_g", "uV_g", "µV_g", "V_g2", "V/g", "mV/g", "uV/g", "µV/g", "V/g^2"),
    *("ug_g2", "µg/g²", "deg_h", "deg_s", "deg/h", "deg/s", "V", "mV", "uV", "µV", "g", "mg", "ug", "µg"),
    *("arcsec", "arcmin", "mrad", "urad", "µrad", "rad", "deg", "ppm", "percent", "Hz"),
)
"""Units of parameters, those of two words first, as they would otherwise be taken for the last word alone."""
_EVERYDAY: Final = ("percent", "deg", "rad", "Hz", "deg_h", "deg_s", "deg/h", "deg/s")
"""Units that all kinds of things have: the quantity must be one of `_PARAMETERS`."""
_PARAMETERS: Final = re.compile(
    r"bias|offset|null|zero|scale|scalefactor|sensitivity|gain|k|kxy|kxx|kyy|kzz|kxxx|u|alpha|angle|"
    r"misalignment|orthogonality|nonorthogonality|drift|hysteresis|nonlinearity|norm|cross|m|eps|epsilon|"
    r"resonance|backlash|eccentricity"
)
"""Words for parameters of a sensor or a stand, without the axis or number after them."""
_SURROUNDINGS: Final = re.compile(
    r"humidity|rh|pressure|dew|wind|rain|battery|supply|vcc|vdd|vref|light|co|altitude|power"
)
"""Words for what surrounds a sensor."""
_SIGNALS: Final = re.compile(
    r"voltage|voltages|output|outputs|signal|signals|reading|readings|acc|accel|acceleration|accelerometer|gyr|"
    r"gyro|gyroscope|rate|mag|magnetometer|adev|oadev|mdev|allan|avar|sigma|sd|std|noise|psd|tau|adc|raw|count|"
    r"counts|channel|ch|sensor|probe|outer|inner|azimuth|heading|latitude|tilt|reference|current|ai|ao|ap|gi|"
    r"go|gp"
)
"""Words for what is read from one moment to the next, unless a word for a parameter stands beside them."""
_AXES: Final = re.compile(r"^(a|u|f|g|w|v)?_?[xyz]$")
"""Nothing but an axis: a signal along it."""
_HEAD: Final = ("angle", "angles")
"""The setting of a head."""
_ORDINALS: Final = re.compile(
    r"run|row|realisation|realization|position|position_id|index|number|no|n|samples|count|cycle|point|id|"
    r"dwell|set|step|line|record"
)
_TIMES: Final = re.compile(
    r"(^|_)(time|date|timestamp|datetime|clock)(_|$)|_(s|ms|us|min|h|hours|minutes|seconds|days)$", re.IGNORECASE
)
_TEMPERATURES: Final = re.compile(r"_degC$")


class Column(Enum):
    """What a column is."""

    TEMPERATURE = "temperature"
    ORDINAL = "ordinal"
    TIME = "time"
    PARAMETER = "parameter"
    UNKNOWN = "unknown"


def column_of(name: str) -> Column:
    """What the name of a column says that it is."""
    if _TEMPERATURES.search(name):
        return Column.TEMPERATURE
    if _ORDINALS.fullmatch(name.lower()):
        return Column.ORDINAL
    if unit_of(name) and _is_parameter(name):
        return Column.PARAMETER
    return Column.TIME if _TIMES.search(name) else Column.UNKNOWN


def _is_parameter(name: str) -> bool:
    unit = unit_of(name)
    quantity = name[: -len(unit) - 1].lower()
    words = [word.rstrip("0123456789") for word in re.split(r"[_\W]+", quantity)]
    if not quantity or quantity in _HEAD or _AXES.match(quantity) or _any(_SURROUNDINGS, words):
        return False
    if _any(_PARAMETERS, [*words, *(word.rstrip("xyz") for word in words)]):
        return True
    return unit not in _EVERYDAY and not _any(_SIGNALS, words)


def _any(known: re.Pattern[str], words: Sequence[str]) -> bool:
    return any(known.fullmatch(word) for word in words)


def unit_of(name: str) -> str:
    """Unit of a parameter in the name of its column; none where the name does not end in one."""
    return next((unit for unit in _UNITS if name.endswith(f"_{unit}")), "")


def named(header: Sequence[str], kind: Column) -> list[str]:
    """Columns of one kind."""
    return [name for name in header if column_of(name) is kind]


def says_runs(columns: Sequence[str]) -> bool:
    """Whether the columns of numbers say that they are a temperature and parameters, and none is anything else."""
    return bool(named(columns, Column.TEMPERATURE)) and not named(columns, Column.UNKNOWN)
