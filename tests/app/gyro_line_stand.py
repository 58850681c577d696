"""A turntable and a platform that sends lines, in virtual time: the real driver, and the emulated instrument."""

from dataclasses import dataclass, replace

from tumble.app.running import Job, failure, run
from tumble.app.simulation import switching_on
from tumble.app.stand import load_stand
from tumble.app.wiring import Connected, obliging_operator
from tumble.drivers.clock import VirtualClock
from tumble.drivers.errors import DeviceError, LinkLostError, NoReplyError
from tumble.drivers.lines.declaration import LinesTable
from tumble.drivers.lines.sampler import LineSampler, Requests
from tumble.drivers.protocols import Identity, Stand
from tumble.drivers.simulated.gyro_platform.settings import SimulatedPlatform
from tumble.drivers.simulated.gyro_platform.world import PlatformWorld
from tumble.drivers.simulated.worlds import Surroundings
from tumble.emulators.faults import Fault, Faults
from tumble.emulators.lines import EmulatedLines, LinesSession
from tumble.emulators.world import SharedWorld
from tumble.procedures.operator import SeatingOperator
from tumble.procedures.programmes import programme_from_text

PROGRAMME = """method = "gyrocompass"
name = "short"
samples = 20
settle_samples = 5
settle_timeout_s = 8.0

[[procedure]]
positions = "0/180/90"
"""
TABLE = {
    "driver": "lines",
    "url": "socket://127.0.0.1:1",
    "rate_hz": 10.0,
    "columns": ["n", "S", "S2", "gamma", "beta", "T"],
    "checksum": "crc16",
    "counter": "n",
    "measured": {
        "levelling_rate_deg_h": {"column": "S", "range": [-400.0, 400.0]},
        "azimuth_rate_deg_h": {"column": "S2", "range": [-400.0, 400.0]},
        "tilt_gamma_deg": {"column": "gamma"},
        "tilt_beta_deg": {"column": "beta"},
    },
    "temperature": {"column": "T"},
    "identity_request": "ID?",
}


class VirtualLine:
    """A serial line in virtual time to an emulated instrument; `gone_s` is how long it is away once it is `lost`."""

    def __init__(self, clock, instrument):
        self._clock, self._instrument = clock, instrument
        self._session, self._waiting = LinesSession(instrument), b""
        self._back_s = 0.0

    def lose(self, gone_s):
        self._back_s = self._clock.monotonic_s() + gone_s

    def write(self, data):
        self._check()
        self._waiting += self._session.received(data)

    def read_line(self, terminator, timeout_s):
        deadline_s = self._clock.monotonic_s() + timeout_s
        while terminator not in self._waiting:
            self._check()
            if self._clock.monotonic_s() > deadline_s:
                raise NoReplyError("serial DAQ", "gave no answer", "check it")
            self._clock.sleep(0.05)
            self._waiting += self._session.due()
        line, end, self._waiting = self._waiting.partition(terminator)
        return line + end

    def discard_input(self):
        self.reopen()  # what came while nobody listened is lost

    def reopen(self):
        self._check()
        self._session = LinesSession(self._instrument)
        self._waiting = b""

    def _check(self):
        if self._clock.monotonic_s() < self._back_s:
            raise LinkLostError("serial DAQ", "the link is lost", "check its cable")


class Turntable:
    """The simulated turntable with faults of its own; each begins when a target is asked for the `at`-th time."""

    def __init__(self, head, clock, fault="", at=3):
        self._head, self._clock, self._fault, self._at = head, clock, fault, at
        self._moves = 0
        self._back_s = 0.0
        self.referenced = True
        self.told = False
        self.limits_deg, self.speed_deg_s = head.limits_deg, head.speed_deg_s

    def identify(self):
        self._check()
        return Identity(model="turntable", serial="T2" if self.faulty("swapped") and self._back_s else "T1")

    def faulty(self, kind):
        return self._fault == kind and self._moves >= self._at

    def home(self):
        self._check()
        self.referenced = True
        self._head.home()

    def start_move(self, angle_deg):
        self._check()
        self._moves += 1
        if self._moves == self._at and self._fault in ("away", "swapped", "away for ever"):
            self._back_s = self._clock.monotonic_s() + (1e9 if self._fault == "away for ever" else 5.0)
        if self._moves == self._at and self._fault == "unreferenced":
            self.referenced = False
        if self.faulty("refuses"):
            raise DeviceError("turntable", "refused the move", "look at it")
        self._head.start_move(angle_deg + 5.0 if self.faulty("elsewhere") else angle_deg)

    def status(self):
        self._check()
        if self.faulty("stalls") and not self.told:
            self.told = True
            self._head.stop()
            raise DeviceError("turntable", "has stalled", "look what blocks it")
        if self.faulty("broken driver") and not self.told:
            self.told = True
            raise ZeroDivisionError("a fault of the driver")
        status = replace(self._head.status(), referenced=self.referenced)
        return replace(status, moving=True) if self.faulty("moves for ever") else status

    def stop(self):
        self._check()
        self._head.stop()

    def reconnect(self):
        self._check()

    def _check(self):
        if self._clock.monotonic_s() < self._back_s:
            raise LinkLostError("turntable", "the link is lost", "check its cable")


@dataclass(kw_only=True)
class LineStand:
    """Everything at hand, before the run and after it."""

    clock: VirtualClock
    world: PlatformWorld
    line: VirtualLine
    turntable: Turntable
    connected: Connected
    job: Job

    def run(self, path, listeners=()):
        """Run the programme; returns exit status and outcome."""
        outcome = run(self.job, self.connected, path, listeners)
        error = failure(outcome, path)
        return int(error.status) if error else 0, outcome


def line_stand(*faults, turntable="", programme=PROGRAMME, operator=None, world=None):
    """A stand whose platform has these faults, each a `kind`, `at` and `times`, and whose turntable has one."""
    clock = VirtualClock(wall_start_ns=0)
    made = PlatformWorld(SimulatedPlatform.model_validate(world or {}), Surroundings(clock=clock))
    told = Faults(None, "platform", clock, lambda: made.counts.dwells)
    for fault in faults:
        told.add(Fault.model_validate({"device": "platform", **fault}))
    table = LinesTable.model_validate(TABLE)
    shared = SharedWorld(_Lived(Stand(name="s", positioners={}, samplers={}, clock=clock), made))
    instrument = EmulatedLines(shared.wired_to(head="azimuth", channels=tuple(table.measured)), table, told)
    line = VirtualLine(clock, instrument)
    sampler = LineSampler(line, table.form, clock, Requests(identity="ID?"), modulus=table.counter_modulus)
    axis = Turntable(made.head, clock, turntable)
    stand = Stand(name="lines", positioners={"azimuth": axis}, samplers={"platform": sampler}, clock=clock)
    asked = SeatingOperator(operator or obliging_operator(), made.setters)
    connected = Connected(stand=stand, operator=asked, listeners=(switching_on(made.switch_on),))
    loaded = load_stand(method="gyrocompass")
    job = Job(stand=loaded, programme=programme_from_text(programme, "p.toml"), serial_number="G-1")
    return LineStand(clock=clock, world=made, line=line, turntable=axis, connected=connected, job=job)


@dataclass
class _Lived:
    stand: Stand
    world: PlatformWorld
