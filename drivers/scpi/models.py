"""Which multimeters are known by name, and what one can do and another cannot.

Figures are those of the data sheets and manuals of the models, in the places that `dialects` cites.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Final

from tumble.drivers.errors import DeviceError
from tumble.drivers.protocols import Identity
from tumble.drivers.scpi.dialects import (
    COMMON,
    DMM6500,
    KEITHLEY_2000,
    RIGOL,
    SCANNER,
    SIGLENT,
    TRUEVOLT,
    TRUEVOLT_TIMER,
    Dialect,
)
from tumble.messages import Message

DECADES_V: Final = (0.1, 1.0, 10.0, 100.0, 1000.0)
TWICE_DECADES_V: Final = (0.2, 2.0, 20.0, 200.0, 1000.0)
SIX_TIMES_DECADES_V: Final = (0.6, 6.0, 60.0, 600.0, 1000.0)


@dataclass(frozen=True, kw_only=True)
class Model:
    """What DC voltage readings of a model can be."""

    makers: tuple[str, ...]
    """How the maker's name begins, in small letters."""
    dialect: Dialect
    nplc: tuple[float, ...] = ()
    """Integration times that can be chosen, in power-line cycles, rising."""
    memory: int
    """How many readings are kept until they are fetched."""
    least: int = 1
    """The fewest readings that it keeps."""
    ranges_v: tuple[float, ...] = DECADES_V
    most_hz: float | None = None
    """The most readings a second, where the integration time alone does not say it."""


_KEYSIGHT: Final = ("keysight", "agilent", "hewlett")
_SLOW: Final = (0.02, 0.2, 1.0, 10.0, 100.0)
_TIMED: Final = (0.02, 0.06, 0.2, 1.0, 10.0, 100.0)
_FAST: Final = (0.006, 0.02, 0.06, 0.2, 1.0, 2.0, 10.0, 100.0)

_34460A: Final = Model(makers=_KEYSIGHT, dialect=TRUEVOLT, nplc=_SLOW, memory=1_000)
_34465A: Final = Model(makers=_KEYSIGHT, dialect=TRUEVOLT_TIMER, nplc=_TIMED, memory=50_000)
_SDM3055: Final = Model(
    makers=("siglent",),
    dialect=SIGLENT,
    nplc=(0.3, 1.0, 10.0),
    memory=1_000,
    ranges_v=TWICE_DECADES_V,
    most_hz=150.0,
)
_SDM3065X: Final = replace(_SDM3055, nplc=(0.005, 0.05, 0.5, 1.0, 10.0, 100.0), memory=10_000)
_DM3058: Final = Model(
    makers=("rigol",), dialect=RIGOL, nplc=_SLOW, memory=512, ranges_v=TWICE_DECADES_V, most_hz=123.0
)

MODELS: Mapping[str, Model] = {
    "34460A": _34460A,
    "34461A": replace(_34460A, memory=10_000),
    "34465A": _34465A,
    "34470A": _34465A,
    "34410A": replace(_34465A, nplc=_FAST),
    "34411A": replace(_34465A, nplc=(0.001, 0.002, *_FAST), memory=1_000_000),
    "2000": Model(
        makers=("keithley",), dialect=KEITHLEY_2000, nplc=(0.01, 0.1, 1.0, 10.0), memory=1024, least=2, most_hz=1000.0
    ),
    "DMM6500": Model(makers=("keithley",), dialect=DMM6500, nplc=(0.0005, 0.001, 0.01, 0.1, 1.0, 10.0), memory=100_000),
    "SDM3045X": replace(_SDM3055, ranges_v=SIX_TIMES_DECADES_V),
    "SDM3055": _SDM3055,
    "SDM3055X-E": _SDM3055,
    "SDM3065X": _SDM3065X,
    "SDM3065X-SC": _SDM3065X,
    "DM3058": _DM3058,
    "DM3058E": _DM3058,
    "DM3068": _DM3058,
}
"""Memory of the Rigol: what the Agilent 34401A keeps, whose commands it is told."""

_34970A: Final = Model(
    makers=_KEYSIGHT, dialect=SCANNER, nplc=(0.02, 0.2, 1.0, 2.0, 10.0, 20.0, 100.0, 200.0), memory=50_000
)
_DAQ970A: Final = replace(_34970A, nplc=(0.02, 0.06, 0.2, 1.0, 2.0, 10.0, 20.0, 100.0, 200.0), memory=100_000)
SCANNERS: Final[Mapping[str, Model]] = {
    "34970A": _34970A,
    "34972A": _34970A,
    "DAQ970A": _DAQ970A,
    "DAQ973A": _DAQ970A,
}
"""Those that switch one voltmeter from channel to channel."""

UNKNOWN: Final = Model(makers=("",), dialect=COMMON, nplc=_SLOW, memory=1)
"""Any other, where the stand file asks for the common core."""


def known(identity: Identity, models: Mapping[str, Model] = MODELS) -> Model:
    """The model of a multimeter. Raises `DeviceError` where it is not known by name."""
    maker, _, name = identity.model.rpartition(" ")
    model = models.get(name.upper())
    if model is None or not maker.casefold().startswith(model.makers):
        if models is SCANNERS:
            raise DeviceError(
                Message("scanner"),
                Message("says that it is {model!r}, which is none that is known by name", model=identity.model),
                Message("connect {models}", models=", ".join(models)),
            )
        raise DeviceError(
            Message("multimeter"),
            Message(
                "says that it is {model!r}, which is not among the meters that are known by name", model=identity.model
            ),
            Message(
                'write dialect = "common" in [daq] to use it as any meter with SCPI, or connect {models}',
                models=", ".join(MODELS),
            ),
        )
    return model
