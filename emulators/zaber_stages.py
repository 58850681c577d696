"""The emulated Zaber stages on one line, as a stand file has them."""

from collections.abc import Mapping

from tumble.drivers.driver import SIMULATED
from tumble.drivers.tables import HeadTable
from tumble.emulators.faults import Faults
from tumble.emulators.world import SharedWorld
from tumble.emulators.zaber import EmulatedZaber
from tumble.emulators.zaber_axis import ZaberAxis
from tumble.messages import Message

_SERIAL = 51_234


def stages(shared: SharedWorld, tables: Mapping[str, HeadTable], faults: Mapping[str, Faults]) -> list[EmulatedZaber]:
    """The stages of a line: axes that the stand file gives to one device are in one.

    Raises `ValueError` where the axes of a device are not 1, 2 and so on.
    """
    devices: dict[int, dict[int, str]] = {}
    for number, (name, table) in enumerate(tables.items(), start=1):
        device, axis = _place(table, number)
        devices.setdefault(device, {})[axis] = name
    return [_stage(shared, tables, faults, device, axes) for device, axes in sorted(devices.items())]


def _place(table: HeadTable, number: int) -> tuple[int, int]:
    """Numbers of device and axis; those that are only simulated are the axes of one device."""
    if table.driver == SIMULATED:
        return 1, number
    return getattr(table, "device", 1), getattr(table, "axis", 1)


def _stage(
    shared: SharedWorld,
    tables: Mapping[str, HeadTable],
    faults: Mapping[str, Faults],
    device: int,
    axes: dict[int, str],
) -> EmulatedZaber:
    if sorted(axes) != list(range(1, len(axes) + 1)):
        raise ValueError(
            Message(
                "the emulated device {device} has the axes 1 to {count}, and the stand file names {axes}",
                device=device,
                count=len(axes),
                axes=", ".join(map(str, sorted(axes))),
            )
        )
    first, *others = (axes[number] for number in sorted(axes))
    further = [ZaberAxis(shared.wired_to(head=name), tables[name].steps_per_deg, faults[name]) for name in others]
    return EmulatedZaber(
        shared.wired_to(head=first),
        steps_per_deg=tables[first].steps_per_deg,
        faults=faults[first],
        serial=_SERIAL + device - 1,
        address=device,
        further=further,
    )
