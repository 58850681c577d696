"""SCPI multimeters, over a serial line or a socket.

- `ScpiMultimeter`: the meter as the DAQ of a stand.
- `models`, `dialects`: which meters are known by name, and how each wants to be told.
- `codec`, `plain`: messages and answers, and what may be believed of them.
"""

from tumble.drivers.scpi.meter import ScpiMultimeter

__all__ = ["ScpiMultimeter"]
