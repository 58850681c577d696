"""What can be set at the multimeter, by model."""

from tumble.emulators.scpi.kinds import Choice, Count, Quantity, Setting, Switch, Text
from tumble.emulators.scpi.models import Model

_SENSE = "[SENSe]:VOLTage[:DC]"


def settings_of(model: Model) -> dict[str, Setting]:
    """Every setting of a model by a short name."""
    everybodys = _everybodys(model)
    more = {"keithley 2000": _keithley_2000, "dmm6500": _dmm6500, "siglent": _siglent, "rigol": _rigol}
    return everybodys | (more[model.family]() if model.family in more else {})


def _everybodys(model: Model) -> dict[str, Setting]:
    """Those of the Truevolt series, which others share."""
    nplc = Quantity(low=model.nplc[0], high=model.nplc[-1], default=10.0, steps=model.nplc)
    volts = Quantity(
        low=model.ranges_v[0], high=model.ranges_v[-1], default=model.ranges_v[2], unit="V", steps=model.ranges_v
    )
    seconds = Quantity(low=0.0, high=3600.0, default=0.0, unit="S")
    on, off = Switch(default=1.0), Switch(default=0.0)
    return {
        "nplc": Setting(header=f"{_SENSE}:NPLCycles", kind=nplc, also={"aperture_on": 0.0}),
        "aperture_s": Setting(
            header=f"{_SENSE}:APERture",
            kind=Quantity(low=2e-5, high=2.0, default=0.2, unit="S"),
            also={"aperture_on": 1.0},
        ),
        "aperture_on": Setting(header=f"{_SENSE}:APERture:ENABled", kind=off),
        "range_v": Setting(header=f"{_SENSE}:RANGe[:UPPer]", kind=volts, also={"autorange": 0.0}),
        "autorange": Setting(header=f"{_SENSE}:RANGe:AUTO", kind=on),
        "autozero": Setting(header=f"{_SENSE}:ZERO:AUTO", kind=on),
        "trigger_source": Setting(
            header="TRIGger:SOURce",
            kind=Choice(choices=("IMMediate", "BUS", "EXTernal", "INTernal"), default="IMM"),
        ),
        "trigger_count": Setting(header="TRIGger:COUNt", kind=Count(low=1.0, high=1e6, default=1.0, unlimited=True)),
        "delay_s": Setting(header="TRIGger:DELay", kind=seconds, also={"auto_delay": 0.0}),
        "auto_delay": Setting(header="TRIGger:DELay:AUTO", kind=on),
        "slope": Setting(header="TRIGger:SLOPe", kind=Choice(choices=("POSitive", "NEGative"), default="NEG")),
        "samples": Setting(header="SAMPle:COUNt", kind=Count(low=1.0, high=1e6, default=1.0)),
        "pretrigger": Setting(header="SAMPle:COUNt:PRETrigger", kind=Count(low=0.0, high=49999.0, default=0.0)),
        "sample_source": Setting(header="SAMPle:SOURce", kind=Choice(choices=("IMMediate", "TIMer"), default="IMM")),
        "timer_s": Setting(header="SAMPle:TIMer", kind=seconds),
        "display": Setting(header="DISPlay[:STATe]", kind=on),
        "display_text": Setting(header="DISPlay:TEXT[:DATA]", kind=Text()),
        "language": Setting(header="*LANG", kind=Choice(choices=("SCPI", "TSP"), default="SCPI")),
    }


def _keithley_2000() -> dict[str, Setting]:
    """Model 2000 Multimeter User's Manual, 5: SENSe, SYSTem, FORMat, TRACe and TRIGger subsystems."""
    on, off = Switch(default=1.0), Switch(default=0.0)
    sources = ("IMMediate", "BUS", "EXTernal", "TIMer", "MANual")
    seconds = Quantity(low=0.0, high=999_999.999, default=0.0, unit="S")
    return {
        "autozero": Setting(header="SYSTem:AZERo:STATe", kind=on),
        "average": Setting(header=f"{_SENSE}:AVERage:STATe", kind=on),
        "digits": Setting(header=f"{_SENSE}:DIGits", kind=Count(low=4.0, high=7.0, default=7.0)),
        "continuous": Setting(header="INITiate:CONTinuous", kind=off),
        "trigger_source": Setting(header="TRIGger:SOURce", kind=Choice(choices=sources, default="IMM")),
        "delay_s": Setting(header="TRIGger[:SEQuence]:DELay", kind=seconds, also={"auto_delay": 0.0}),
        "timer_s": Setting(header="TRIGger:TIMer", kind=Quantity(low=1e-3, high=999_999.999, default=0.1)),
        "format": Setting(header="FORMat[:DATA]", kind=Choice(choices=("ASCii", "SREal", "DREal"), default="ASC")),
        "elements": Setting(
            header="FORMat:ELEMents", kind=Choice(choices=("READing", "CHANnel", "UNITs"), default="READ")
        ),
        "points": Setting(header="TRACe:POINts", kind=Count(low=2.0, high=1024.0, default=100.0)),
        "feed": Setting(header="TRACe:FEED", kind=Choice(choices=("SENSe", "CALCulate", "NONE"), default="CALC")),
        "feed_control": Setting(header="TRACe:FEED:CONTrol", kind=Choice(choices=("NEVer", "NEXT"), default="NEV")),
        "measurement_mask": Setting(header="STATus:MEASurement:ENABle", kind=Count(low=0.0, high=65535.0, default=0.0)),
        "beeper": Setting(header="SYSTem:BEEPer:STATe", kind=off),
    }


def _dmm6500() -> dict[str, Setting]:
    """Model DMM6500 Reference Manual, 12."""
    return {
        "autozero": Setting(header=f"{_SENSE}:AZERo[:STATe]", kind=Switch(default=1.0)),
        "average": Setting(header=f"{_SENSE}:AVERage[:STATe]", kind=Switch(default=0.0)),
        "format": Setting(header="FORMat[:DATA]", kind=Choice(choices=("ASCii", "REAL", "SREal"), default="ASC")),
    }


def _siglent() -> dict[str, Setting]:
    """SDM Series Programming Guide, 6.6.9 and 6.6.10."""
    return {
        "autozero": Setting(header=f"{_SENSE}:AZ[:STATe]", kind=Switch(default=0.0)),
        "filter": Setting(header=f"{_SENSE}:FILTer[:STATe]", kind=Switch(default=1.0)),
    }


def _rigol() -> dict[str, Setting]:
    """Programming Guide for DM3058/DM3058E, 1 and 4."""
    return {
        "autozero": Setting(header="[SENSe]:ZERO:AUTO", kind=Switch(default=1.0)),
        "command_set": Setting(header="CMDSet", kind=Choice(choices=("RIGOL", "AGILENT", "FLUKE"), default="RIGOL")),
    }
