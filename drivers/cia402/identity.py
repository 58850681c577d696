"""Who a drive says it is, as far as it says anything: CiA 301 lets it leave out all of it but its vendor."""

from tumble.drivers.cia402 import objects
from tumble.drivers.cia402.node import DriveNode
from tumble.drivers.protocols import Identity

NAMELESS = "CiA 402 drive"


def identity_of(node: DriveNode) -> Identity:
    """Name, serial number and software version; empty what it does not say. Raises `LinkLostError`, `NoReplyError`."""
    offered = node.read_where_offered
    numbers = {
        what: offered(objects.IDENTITY, member)
        for what, member in (("vendor", objects.VENDOR), ("product", objects.PRODUCT))
    }
    known = ", ".join(f"{what} {number:X}h" for what, number in numbers.items() if number is not None)
    name = offered(objects.DEVICE_NAME) or NAMELESS
    serial = offered(objects.IDENTITY, objects.SERIAL)
    return Identity(
        model=f"{name} ({known})" if known else str(name),
        serial="" if serial is None else str(serial),
        firmware=str(offered(objects.SOFTWARE_VERSION) or ""),
    )
