"""How families of multimeters want to be told the same thing: dialects of SCPI, as data.

A setting is a command with one value, `VOLT:DC:NPLC {nplc}`, and is read back by the header with a question mark. What
stands in braces is filled in: `expected_v` and `range_v` (the smallest range that holds that), `nplc`, `interval_s`
(from one reading to the next), `spare_s` (what the integration leaves of that), `count`.

Sources, by the names that the entries cite:

- Truevolt: Keysight, Truevolt Series Operating and Service Guide (34460-90901), "SCPI Programming Reference".
- 34410A: Agilent 34410A/11A Programmer's Reference (SCPI); QCoDeS 0.58, `Keysight_344xxA`, which is used with both.
- Keithley 2000: Model 2000 Multimeter User's Manual (2000-900-01 Rev. J), 3 "Buffer operations", 4 "Trigger model" and
  5 "SCPI Command Reference"; PyMeasure 0.16, `Keithley2000` and `KeithleyBuffer`; QCoDeS 0.58, `Keithley_2000`; the
  PyVISA manual's example.
- DMM6500: Model DMM6500 Reference Manual (DMM6500-901-01), 12 "SCPI command reference"; PyMeasure 0.16,
  `KeithleyDMM6500`; QCoDeS 0.58, `Keithley_6500`.
- Siglent: SDM Series Programming Guide (EN02A).
- Rigol: Programming Guide for DM3058/DM3058E, 1 (`CMDSET`) and 4 "Compatible Agilent commands" (the set of the Agilent
  34401A); python-ivi, `rigolDM3068Agilent`.
"""

from dataclasses import dataclass, replace
from typing import Final


@dataclass(frozen=True, kw_only=True)
class Dialect:
    """How a family is set up, begins to measure, and gives its readings."""

    name: str
    source: str
    compound: bool = False
    """Whether it may be asked several things in one message; whether a meter really can is found out."""
    language: tuple[str, ...] = ()
    """Settings that choose among the languages that it speaks."""
    prepare: tuple[str, ...] = ("ABOR", "*CLS")
    """Commands that end what it is doing and forget errors."""
    configure: tuple[str, ...] = ("CONF:VOLT:DC",)
    """Commands that choose DC voltage."""
    function: str = "FUNC?"
    """Asks what it measures."""
    functions: tuple[str, ...] = ("VOLT", "VOLT:DC")
    """How it may say that this is DC voltage, within quotation marks or without."""
    fixed_range: str = "VOLT:DC:RANG {range_v}"
    autorange: str = "VOLT:DC:RANG:AUTO 1"
    settings: tuple[str, ...]
    """Settings that follow that of the range."""
    optional: frozenset[str] = frozenset()
    """Headers of the settings without which it measures all the same."""
    arm: tuple[str, ...] = ()
    """Commands behind the settings that cannot be read back."""
    begin: tuple[str, ...] = ("INIT",)
    fetch: str = "FETC?"
    """Asks for the readings, as often as one likes."""
    singly: bool = False
    """Whether readings are taken one by one, at the pace of the computer."""
    keeps: bool = True
    """Whether readings can be asked for again; where they cannot, `READ?` begins and answers in one."""
    line_hz: str = ""
    """Asks for the frequency of the power line; nothing where it cannot be asked."""
    temperature: tuple[str, ...] = ()
    """Command that chooses temperature, and settings behind it; nothing where it is not known how."""


TRUEVOLT: Final = Dialect(
    name="Truevolt",
    source="Truevolt, MEASure and CONFigure, SAMPle, TRIGger and SENSe:VOLTage subsystems",
    compound=True,
    settings=("VOLT:DC:NPLC {nplc}", "VOLT:DC:ZERO:AUTO 0", "TRIG:DEL {spare_s}", "SAMP:COUN {count}"),
    line_hz="SYST:LFR?",
    temperature=("CONF:TEMP {sensor}",),
)
"""Without a sample timer; the trigger delay stands before every sample."""

TRUEVOLT_TIMER: Final = replace(
    TRUEVOLT,
    name="Truevolt with a sample timer",
    source="Truevolt, SAMPle:TIMer (34465A and 34470A); 34410A, SAMPle:TIMer",
    settings=(
        "VOLT:DC:NPLC {nplc}",
        "VOLT:DC:ZERO:AUTO 0",
        "TRIG:DEL 0",
        "SAMP:SOUR TIM",
        "SAMP:TIM {interval_s}",
        "SAMP:COUN {count}",
    ),
)

KEITHLEY_2000: Final = Dialect(
    name="Keithley 2000",
    source="Keithley 2000, 3-17 (buffer), 4-29 (idle), 5-37 (SENSe), 5-68 (TRACe), 5-70 (TRIGger)",
    prepare=("INIT:CONT 0", "ABOR", "*CLS"),
    configure=('FUNC "VOLT:DC"', "FORM ASC", "FORM:ELEM READ", "TRAC:FEED:CONT NEV", "TRAC:CLE"),
    functions=("VOLT:DC",),
    settings=(
        "VOLT:DC:NPLC {nplc}",
        "VOLT:DC:AVER:STAT 0",
        "SYST:AZER:STAT 0",
        "SAMP:COUN 1",
        "TRIG:SOUR TIM",
        "TRIG:TIM {interval_s}",
        "TRIG:DEL 0",
        "TRIG:COUN {count}",
        "TRAC:POIN {count}",
    ),
    optional=frozenset({"SYST:AZER:STAT"}),
    arm=("TRAC:FEED SENS", "TRAC:FEED:CONT NEXT"),
    fetch="TRAC:DATA?",
)
"""Readings go through its buffer; out of idle it reads no other command until it has taken them all."""

DMM6500: Final = Dialect(
    name="DMM6500",
    source="DMM6500, 12: SENSe1 and TRACe subsystems, TRIGger:LOAD SimpleLoop, *LANG",
    language=("*LANG SCPI",),
    configure=('SENS:FUNC "VOLT:DC"', "FORM ASC", 'TRAC:CLE "defbuffer1"'),
    function="SENS:FUNC?",
    functions=("VOLT:DC",),
    fixed_range="SENS:VOLT:DC:RANG {range_v}",
    autorange="SENS:VOLT:DC:RANG:AUTO 1",
    settings=("SENS:VOLT:DC:NPLC {nplc}", "SENS:VOLT:DC:AZER 0", "SENS:VOLT:DC:AVER 0"),
    optional=frozenset({"SENS:VOLT:DC:AZER", "SENS:VOLT:DC:AVER"}),
    arm=('TRIG:LOAD "SimpleLoop",{count},{spare_s},"defbuffer1"',),
    begin=("INIT", "*WAI"),
    fetch='TRAC:DATA? 1,{count},"defbuffer1",READ',
    line_hz="SYST:LFR?",
)

SIGLENT: Final = Dialect(
    name="Siglent SDM",
    source="Siglent, 1.8 to 1.14 (FETCh? erases nothing; INITiate clears), 6.6 (NPLC, AZ, FILTer), 8 (TRIGger)",
    settings=(
        "VOLT:DC:NPLC {nplc}",
        "VOLT:DC:AZ 0",
        "VOLT:DC:FILT 0",
        "TRIG:SOUR IMM",
        "TRIG:DEL {spare_s}",
        "SAMP:COUN 1",
        "TRIG:COUN {count}",
    ),
    optional=frozenset({"VOLT:DC:AZ", "VOLT:DC:FILT", "TRIG:DEL"}),
    temperature=("CONF:TEMP {sensor}", "SAMP:COUN 1", "TRIG:COUN 1"),
)
"""Autozero is a command of the SDM3065X alone, the filter one of the others."""

RIGOL: Final = Dialect(
    name="Rigol DM3058 and DM3068",
    source="Rigol, 1 (CMDSET) and 4 (SENSe, SAMPle, TRIGger as the Agilent 34401A has them)",
    language=("CMDSET AGILENT",),
    settings=(
        "VOLT:DC:NPLC {nplc}",
        "ZERO:AUTO 0",
        "TRIG:SOUR IMM",
        "TRIG:DEL {spare_s}",
        "SAMP:COUN 1",
        "TRIG:COUN {count}",
    ),
    optional=frozenset({"VOLT:DC:NPLC", "ZERO:AUTO", "TRIG:DEL"}),
    temperature=("CONF:TEMP {sensor}", "SAMP:COUN 1", "TRIG:COUN 1"),
)
"""Its own language, in which it wakes, gives one reading at a time; NPLC only chooses among its three speeds."""

SCANNER: Final = Dialect(
    name="scanner",
    source="34970A User's Guide (34970-90003), 5: CONFigure, ROUTe:SCAN, TRIGger; DAQ970A Programming Guide",
    compound=True,
    settings=(
        "VOLT:DC:RANG {range_v}",
        "VOLT:DC:NPLC {nplc}",
        "TRIG:SOUR TIM",
        "TRIG:TIM {interval_s}",
        "TRIG:COUN {count}",
    ),
    line_hz="SYST:LFR?",
    temperature=("CONF:TEMP {sensor}", "TRIG:SOUR IMM", "TRIG:COUN 1"),
)
"""A sweep over its scan list takes one reading of every channel; `CONFigure` with a channel list makes that the scan
list. Autozero stays on: the offset of a channel is not that of another."""

COMMON: Final = Dialect(
    name="common",
    source="SCPI-1999, volume 2, 3 (CONFigure, FETCh?, READ?) and 24 (INITiate, ABORt)",
    configure=("CONF:VOLT:DC {expected_v}",),
    fixed_range="",
    autorange="",
    settings=("VOLT:DC:NPLC {nplc}",),
    optional=frozenset({"VOLT:DC:NPLC"}),
    singly=True,
)
"""What every multimeter with SCPI has: one reading, as it is set by itself for the voltage that is expected. Few
lack the integration time (SCPI-1999, volume 2, SENSe:VOLTage:NPLCycles), which makes it as fast as is asked."""
