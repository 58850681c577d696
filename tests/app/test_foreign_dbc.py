"""A stand whose CAN DAQ has a DBC file of its own names, from the stand file to the voltage through the bus."""

from contextlib import ExitStack

import pytest

from tumble.app.stand import load_stand
from tumble.app.wiring import connect
from tumble.drivers.simulated import Simulated, build
from tumble.emulators.emulation import Wanted, emulate
from tumble.emulators.speed import FasterClock
from tumble.emulators.world import SharedWorld
from tumble.procedures.errors import InputError

DBC = """VERSION ""

BU_: Host DAQ

BO_ 768 Cmd: 8 Host
 SG_ Run : 0|8@1+ (1,0) [0|255] "°" DAQ
 SG_ N : 8|24@1+ (1,0) [0|16777215] "" DAQ
 SG_ Hz : 32|32@1- (1,0) [0|0] "Hz" DAQ

BO_ 784 Ack: 8 DAQ
 SG_ Run : 0|8@1+ (1,0) [0|255] "" Host
 SG_ N : 8|24@1+ (1,0) [0|16777215] "" Host
 SG_ Hz : 32|32@1- (1,0) [0|0] "Hz" Host

BO_ 786 ADC: 6 DAQ
 SG_ U : 0|32@1- (1E-005,0) [-20000|20000] "mV" Host
 SG_ Seq : 32|8@1+ (1,0) [0|255] "" Host
 SG_ Run : 40|8@1+ (1,0) [0|255] "" Host

BO_ 788 Info: 8 DAQ
 SG_ SerialNo : 0|32@1+ (1,0) [0|4294967295] "" Host
 SG_ Type : 32|8@1+ (1,0) [0|255] "" Host
 SG_ Version : 40|8@1+ (1,0) [0|255] "" Host

SIG_VALTYPE_ 768 Hz : 1;
SIG_VALTYPE_ 784 Hz : 1;
"""
STAND = """
name = "foreign"
[head]
driver = "cia402"
url = "{head}"
limits_deg = [-180.0, 760.0]
[daq]
driver = "can"
url = "{daq}"
dbc = "logger.dbc"
[daq.signals]
Command = {{ Epoch = "Cmd.Run", Samples = "Cmd.N", Rate = "Cmd.Hz" }}
Started = {{ Epoch = "Ack.Run", Samples = "Ack.N", Rate = "Ack.Hz" }}
Voltage = {{ Voltage = "ADC.{signal}", Counter = "ADC.Seq", Epoch = "ADC.Run" }}
Identity = {{ Serial = "Info.SerialNo", Product = "Info.Type", Firmware = "Info.Version" }}
"""


def stand(folder, signal="U", **where):
    (folder / "logger.dbc").write_bytes(DBC.encode("cp1252"))
    file = folder / "stand.toml"
    file.write_text(STAND.format(signal=signal, **({"head": "virtual:x", "daq": "virtual:x"} | where)))
    return load_stand(file)


def test_the_voltage_of_the_world_comes_through_a_dbc_file_of_others(tmp_path):
    clock = FasterClock(50.0)
    built = build(Simulated(noise_v=0.0), clock=clock)
    with ExitStack() as stack:
        anywhere = stand(tmp_path).file
        wanted = Wanted(head=anywhere.head, daq=anywhere.daq, folder=tmp_path)
        where = emulate(stack, SharedWorld(built), wanted)
        connected = connect(stand(tmp_path, **where), clock=clock)
        stack.callback(connected.links.close)
        block = connected.stand.samplers["daq"].acquire(20, 1000.0)
        assert connected.stand.samplers["daq"].identify().serial == "310001"
    assert block.voltage_v[0] == pytest.approx(built.world.noise_free_voltage(["face-up"], [0.0])[0], abs=1e-6)


def test_a_signal_that_the_file_has_not_is_refused_with_those_that_it_has(tmp_path):
    loaded = stand(tmp_path, signal="Volts")
    with pytest.raises(InputError, match="ADC of the DBC file has no signal Volts; it has Run, Seq, U"):
        connect(loaded)
