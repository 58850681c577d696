"""An emulated multimeter of the 34461A class that speaks SCPI.

- `Multimeter`: the instrument, wired to a shared world.
- `ScpiSession`: one client's conversation with it.
- `MODELS`: the models that it can be.
"""

from emulators.scpi.meter import Multimeter
from emulators.scpi.session import ScpiSession
from emulators.scpi.settings import MODELS

__all__ = ["MODELS", "Multimeter", "ScpiSession"]
