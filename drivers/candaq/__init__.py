"""A DAQ on CAN, described by a DBC file.

- `CanDaq`: acquisition with every frame counted.
- `DaqFrames`: the frames of a DBC file; `tumble_daq.dbc` comes along.
"""

from tumble.drivers.candaq.daq import CanDaq
from tumble.drivers.candaq.frames import DaqFrames, Frame

__all__ = ["CanDaq", "DaqFrames", "Frame"]
