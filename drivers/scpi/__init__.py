"""SCPI multimeters of the 34461A family, over a serial line or a socket.

- `ScpiMultimeter`: the meter as the DAQ of a stand.
- `codec`: messages and answers, and what may be believed of them.
"""

from drivers.scpi.meter import ScpiMultimeter

__all__ = ["ScpiMultimeter"]
