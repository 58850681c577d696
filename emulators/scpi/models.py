"""The models of multimeters that are emulated, and what tells one from the other.

Figures and commands: data sheets and manuals, as `tumble.drivers.scpi.dialects` cites them. What the manuals do not say
is the least that they allow: a command that a manual does not list is not known.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Final, Literal

RANGES_V: Final = (0.1, 1.0, 10.0, 100.0, 1000.0)

Messages = Literal["any", "first", "lines", "one"]
"""What comes of several queries in one message: all answers in one line; the first answer alone, with an error; each
answer in a line of its own; or nothing but an error."""

Family = Literal["keysight", "keithley 2000", "dmm6500", "siglent", "rigol", "plain"]


@dataclass(frozen=True, kw_only=True)
class Model:
    """What differs from one model to the next."""

    maker: str
    firmware: str
    name: str = ""
    """How it calls itself; empty where that is the name in the table."""
    family: Family = "keysight"
    messages: Messages = "any"
    nplc: tuple[float, ...]
    """Integration times in power-line cycles that can be chosen."""
    resolution: tuple[float, ...]
    """Resolution at each of them, as a fraction of the range."""
    ranges_v: tuple[float, ...] = RANGES_V
    memory: int = 100_000
    """The most readings that are taken at once."""
    voltage_function: str = "VOLT"
    """How it names DC voltage when asked for its function."""
    no_error: str = '+0,"No error"'
    enable_mask: int = 255
    """Bits that `*ESE` keeps."""
    deaf: bool = False
    """Whether it reads nothing but ABORt while it measures."""
    lacks: frozenset[str] = frozenset()
    """Headers of commands, as the tables write them, that it does not know; with the queries."""
    only: frozenset[str] = frozenset()
    """All that it knows, where that is not empty."""


_TRUEVOLT: Final = "A.02.17-02.40-02.17-00.52-04-02"
_KEYSIGHT, _AGILENT = "Keysight Technologies", "Agilent Technologies"
_SLOW: Final = (0.02, 0.06, 0.2, 1.0, 10.0, 100.0)
_ONE_TO_FIVE: Final = (1e-4, 1e-5, 3e-6, 1e-6, 3e-7)
_TWICE_DECADES_V: Final = (0.2, 2.0, 20.0, 200.0, 1000.0)
_OF_TRUEVOLT: Final = frozenset(
    {
        "SYSTem:LFRequency",
        "SYSTem:LICense:CATalog",
        "SYSTem:REMote",
        "SYSTem:LOCal",
        "[SENSe]:VOLTage[:DC]:ZERO:AUTO",
        "[SENSe]:VOLTage[:DC]:APERture",
        "[SENSe]:VOLTage[:DC]:APERture:ENABled",
        "SAMPle:SOURce",
        "SAMPle:TIMer",
        "SAMPle:COUNt:PRETrigger",
        "ROUTe:TERMinals",
        "*LANG",
        "*OPT",
    }
)
"""What the models of other makers do not have."""

_34461A: Final = Model(
    maker=_KEYSIGHT, firmware=_TRUEVOLT, nplc=(0.02, 0.2, 1.0, 10.0, 100.0), resolution=_ONE_TO_FIVE, memory=10_000
)
_34465A: Final = Model(
    maker=_KEYSIGHT, firmware=_TRUEVOLT, nplc=_SLOW, resolution=(3e-6, 1.5e-6, 7e-7, 3e-7, 1e-7, 3e-8), memory=50_000
)
_SDM3055: Final = Model(
    maker="Siglent Technologies",
    firmware="1.01.01.25",
    family="siglent",
    messages="first",
    nplc=(0.3, 1.0, 10.0),
    resolution=(3e-5, 1e-5, 3e-6),
    ranges_v=_TWICE_DECADES_V,
    memory=1_000,
    lacks=_OF_TRUEVOLT | {"[SENSe]:VOLTage[:DC]:AZ[:STATe]", "*ESE", "SYSTem:ERRor[:NEXT]", "CONFigure"},
)
_DM3058: Final = Model(
    maker="Rigol Technologies",
    firmware="01.01.00.02.02.00",
    family="rigol",
    messages="one",
    nplc=(0.02, 0.2, 1.0, 10.0, 100.0),
    resolution=_ONE_TO_FIVE,
    ranges_v=_TWICE_DECADES_V,
    memory=512,
    no_error='0,"No error"',
    enable_mask=189,
    lacks=_OF_TRUEVOLT,
)
_PLAIN: Final = Model(
    maker="ACME",
    firmware="1.0",
    family="plain",
    messages="one",
    nplc=(1.0,),
    resolution=(1e-6,),
    no_error='0,"No error"',
    only=frozenset(
        {
            "*IDN",
            "*CLS",
            "*ESE",
            "SYSTem:ERRor[:NEXT]",
            "CONFigure[:SCALar]:VOLTage[:DC]",
            "READ",
            "INITiate[:IMMediate]",
        }
        | {"FETCh", "ABORt"}
    ),
)

MODELS: Mapping[str, Model] = {
    "DAQ970A": replace(_34465A, firmware="A.02.02-01.00-02.01-00.02-02.00-00-00"),
    "34460A": replace(_34461A, memory=1_000),
    "34461A": _34461A,
    "34465A": _34465A,
    "34470A": _34465A,
    "34410A": Model(
        maker=_AGILENT,
        firmware="2.35-2.35-0.09-46-09",
        nplc=(0.006, 0.02, 0.06, 0.2, 1.0, 2.0, 10.0, 100.0),
        resolution=(6e-6, 3e-6, 1.5e-6, 7e-7, 3e-7, 2e-7, 1e-7, 3e-8),
        memory=50_000,
    ),
    "34411A": Model(
        maker=_AGILENT,
        firmware="2.35-2.35-0.09-46-09",
        nplc=(0.001, 0.002, 0.006, 0.02, 0.06, 0.2, 1.0, 2.0, 10.0, 100.0),
        resolution=(3e-5, 1.5e-5, 6e-6, 3e-6, 1.5e-6, 7e-7, 3e-7, 2e-7, 1e-7, 3e-8),
    ),
    "MODEL DMM6500": Model(
        maker="KEITHLEY INSTRUMENTS",
        firmware="1.7.12b",
        family="dmm6500",
        nplc=(0.0005, 0.001, 0.01, 0.1, 1.0, 10.0, 15.0),
        resolution=(1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 2e-7),
        voltage_function="VOLT:DC",
        no_error='0,"No error;0;0 0"',
        lacks=(_OF_TRUEVOLT | {"CONFigure", "CONFigure[:SCALar]:VOLTage[:DC]", "SAMPle:COUNt", "TRIGger:COUNt"})
        - {"*LANG", "SYSTem:LFRequency"},
    ),
    "MODEL 2000": Model(
        maker="KEITHLEY INSTRUMENTS INC.",
        firmware="A20 /A02",
        family="keithley 2000",
        nplc=(0.01, 0.1, 1.0, 10.0),
        resolution=(1e-4, 1e-5, 1e-6, 1e-7),
        memory=1024,
        voltage_function="VOLT:DC",
        no_error='0,"No error"',
        deaf=True,
        lacks=_OF_TRUEVOLT - {"SYSTem:REMote", "SYSTem:LOCal"} | {"TRIGger:DELay:AUTO", "TRIGger:SLOPe"},
    ),
    "SDM3045X": replace(_SDM3055, ranges_v=(0.6, 6.0, 60.0, 600.0, 1000.0)),
    "SDM3055": _SDM3055,
    "SDM3065X": replace(
        _SDM3055,
        nplc=(0.005, 0.05, 0.5, 1.0, 10.0, 100.0),
        resolution=(3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7),
        memory=10_000,
        lacks=_OF_TRUEVOLT | {"[SENSe]:VOLTage[:DC]:FILTer[:STATe]", "CONFigure"},
    ),
    "DM3058": _DM3058,
    "DM3068": _DM3058,
    "PLAIN-5": _PLAIN,
    "READ-ONCE": replace(_PLAIN, only=_PLAIN.only - {"INITiate[:IMMediate]", "FETCh", "ABORt", "*ESE"}),
}
"""`34461A` and its kin take any message. `PLAIN-5` and `READ-ONCE` are of no known make; the latter gives a reading
once only. The SDM3055 has what its guide lists; the SDM3065X is taken to have an error queue and a register besides."""
