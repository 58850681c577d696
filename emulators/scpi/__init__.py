"""Emulated multimeters that speak SCPI: the 34461A class, Keithley, Siglent, Rigol, and a plain one.

- `Multimeter`: the instrument, wired to a shared world.
- `ScpiSession`: one client's conversation with it.
- `MODELS`: the models that it can be, `Model` what tells them apart.
"""

from tumble.emulators.scpi.meter import Multimeter
from tumble.emulators.scpi.models import MODELS, Model
from tumble.emulators.scpi.session import ScpiSession

__all__ = ["MODELS", "Model", "Multimeter", "ScpiSession"]
