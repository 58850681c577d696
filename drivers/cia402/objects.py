"""The objects of a CiA 402 drive that the driver uses and the emulator offers."""

from pathlib import Path
from typing import Final, NamedTuple
from warnings import catch_warnings, simplefilter

from canopen import ObjectDictionary
from canopen.objectdictionary import ODArray, ODRecord, ODVariable, datatypes, export_od

U8, U16, U32 = datatypes.UNSIGNED8, datatypes.UNSIGNED16, datatypes.UNSIGNED32
I8, I16, I32 = datatypes.INTEGER8, datatypes.INTEGER16, datatypes.INTEGER32
TEXT: Final = datatypes.VISIBLE_STRING

DEVICE_TYPE, ERROR_REGISTER, HEARTBEAT_MS = 0x1000, 0x1001, 0x1017
DEVICE_NAME, SOFTWARE_VERSION, IDENTITY = 0x1008, 0x100A, 0x1018
ERROR_CODE, CONTROLWORD, STATUSWORD, QUICK_STOP_OPTION = 0x603F, 0x6040, 0x6041, 0x605A
MODE, MODE_DISPLAY, POSITION, VELOCITY = 0x6060, 0x6061, 0x6064, 0x606C
TARGET_POSITION, POSITION_LIMITS, PROFILE_VELOCITY = 0x607A, 0x607D, 0x6081
HOMING_METHOD, SUPPORTED_MODES = 0x6098, 0x6502

VENDOR, PRODUCT, REVISION, SERIAL = 1, 2, 3, 4
"""Subindices of the identity object."""

_PROFILE_POSITION_AND_HOMING: Final = 1 << 0 | 1 << 5
_SERVO_DRIVE: Final = 0x00020192


class _Row(NamedTuple):
    """One object: a variable, or the members of a record."""

    number: int
    name: str
    kind: int
    access: str
    default: int | None = 0
    members: tuple[str, ...] = ()


_ROWS: Final = (
    _Row(DEVICE_TYPE, "Device type", U32, "ro", _SERVO_DRIVE),
    _Row(ERROR_REGISTER, "Error register", U8, "ro"),
    _Row(DEVICE_NAME, "Manufacturer device name", TEXT, "const", None),
    _Row(SOFTWARE_VERSION, "Manufacturer software version", TEXT, "const", None),
    _Row(HEARTBEAT_MS, "Producer heartbeat time", U16, "rw"),
    _Row(IDENTITY, "Identity", U32, "ro", 0, ("Vendor-ID", "Product code", "Revision number", "Serial number")),
    _Row(ERROR_CODE, "Error code", U16, "ro"),
    _Row(CONTROLWORD, "Controlword", U16, "rw"),
    _Row(STATUSWORD, "Statusword", U16, "ro"),
    _Row(QUICK_STOP_OPTION, "Quick stop option code", I16, "rw", 2),
    _Row(MODE, "Modes of operation", I8, "rw"),
    _Row(MODE_DISPLAY, "Modes of operation display", I8, "ro"),
    _Row(POSITION, "Position actual value", I32, "ro"),
    _Row(VELOCITY, "Velocity actual value", I32, "ro"),
    _Row(TARGET_POSITION, "Target position", I32, "rw"),
    _Row(POSITION_LIMITS, "Software position limit", I32, "rw", 0, ("Min", "Max")),
    _Row(PROFILE_VELOCITY, "Profile velocity", U32, "rw"),
    _Row(HOMING_METHOD, "Homing method", I8, "rw", 35),
    _Row(SUPPORTED_MODES, "Supported drive modes", U32, "ro", _PROFILE_POSITION_AND_HOMING),
)

_PDOS: Final = {
    0x1400: (0x200, (CONTROLWORD,)),
    0x1401: (0x300, (TARGET_POSITION,)),
    0x1800: (0x180, (STATUSWORD, MODE_DISPLAY)),
    0x1801: (0x280, (POSITION, VELOCITY)),
}
"""Communication record, base of its identifier, objects mapped; the map is 200h above the record."""

_EVENT_DRIVEN: Final = 255


def object_dictionary(node_id: int) -> ObjectDictionary:
    """The objects as `canopen` wants them, with the PDOs of the predefined connection set for one node."""
    dictionary = ObjectDictionary()  # type: ignore[no-untyped-call]
    dictionary.node_id = node_id
    for row in _ROWS:
        if row.members:
            members = [_variable(row.number, i, name, row) for i, name in enumerate(row.members, start=1)]
            dictionary.add_object(_record(ODRecord(row.name, row.number), members))
        else:
            dictionary.add_object(_variable(row.number, 0, row.name, row))
    for index, (base, mapped) in _PDOS.items():
        _add_pdo(dictionary, index, base + node_id, mapped)
    return dictionary


def write_eds(path: Path, node_id: int) -> None:
    """Write the object dictionary as an electronic data sheet (CiA 306) for other masters."""
    with catch_warnings():
        simplefilter("ignore", DeprecationWarning)  # `canopen` asks for the time in an old way
        export_od(object_dictionary(node_id), str(path), doc_type="eds")


def _add_pdo(dictionary: ObjectDictionary, index: int, cob_id: int, mapped: tuple[int, ...]) -> None:
    way = "Transmit" if index >= 0x1800 else "Receive"
    settings = [("COB-ID", U32, cob_id), ("Transmission type", U8, _EVENT_DRIVEN)]
    members = [
        _variable(index, i, name, _Row(index, name, kind, "rw", default))
        for i, (name, kind, default) in enumerate(settings, start=1)
    ]
    dictionary.add_object(_record(ODRecord(f"{way} PDO communication parameter", index), members))
    entries = [
        _variable(
            index + 0x200, i, f"Mapped object {i}", _Row(0, "", U32, "rw", target << 16 | len(dictionary[target]))
        )
        for i, target in enumerate(mapped, start=1)
    ]
    dictionary.add_object(_record(ODArray(f"{way} PDO mapping parameter", index + 0x200), entries))


def _mapping(dictionary: ObjectDictionary, target: int) -> int:
    """How a PDO names a variable: index, subindex 0, length in bits."""
    return target << 16 | len(dictionary[target])


def _record(container: ODRecord | ODArray, members: list[ODVariable]) -> ODRecord | ODArray:
    count = _variable(container.index, 0, "Highest sub-index supported", _Row(0, "", U8, "ro", len(members)))
    for member in (count, *members):
        container.add_member(member)
    return container


def _variable(index: int, subindex: int, name: str, row: _Row) -> ODVariable:
    variable = ODVariable(name, index, subindex)
    variable.data_type = row.kind
    variable.access_type = row.access
    variable.default = row.default
    return variable
