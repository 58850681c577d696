"""A dividing head on CANopen: a drive that keeps to CiA 402, on any CAN interface that python-can knows.

- `Cia402Head`: homing, profile position, quick stop; faults in words.
- `object_dictionary`, `write_eds`: the objects that it uses, for other masters too.
- `states`: statusword, controlword and the power state machine.
"""

from tumble.drivers.cia402.head import Cia402Head
from tumble.drivers.cia402.objects import object_dictionary, write_eds

__all__ = ["Cia402Head", "object_dictionary", "write_eds"]
