"""A simulated shaker in virtual time, whose exciter and DAQ go wrong as a test says."""

from fakes import MemorySink

from tumble.app.simulation import simulation
from tumble.app.stand import load_stand
from tumble.drivers.clock import VirtualClock
from tumble.drivers.errors import LinkLostError
from tumble.drivers.protocols import Stand
from tumble.procedures.engine import Engine
from tumble.procedures.events import WarningRaised
from tumble.procedures.operator import Answer
from tumble.procedures.programmes import programme_from_text

STAND = """name = "shaken"
[exciter]
driver = "simulated"
level_limit_g = 10.0
frequency_limits_Hz = [5.0, 500.0]
ramp_s = 1.6
references = { reference_x_v = 0.1 }

[samplers.unit]
driver = "simulated"
channels = ["output_v", "reference_x_v"]
samples = 100
rate_hz = 200.0

[simulated]
world = "vibration"
seed = 5
"""
PROGRAMME = """method = "vibration"
name = "short"
settle_s = 0.1
settle_samples = 10

[[procedure]]
levels_g = [4.0]
frequencies_Hz = [21.3]
mountings = [{}, { x = "o", y = "p", down = "p" }]
"""
LOST = LinkLostError("exciter", "is gone", "look")


class Person:
    """Mounts the unit as asked, and says so, or says something else."""

    def __init__(self, setters):
        self._setters = setters
        self.asked, self.answers = [], {}

    def ask(self, ask):
        self.asked.append(ask)

    def poll(self):
        ask = self.asked[-1]
        text = self.answers.get(ask.value, "yes")
        if text == "yes":
            self._setters[ask.condition](ask.value)
        return Answer(text=text, confirmed=text == "yes")


class Wrapped:
    """An instrument; a test may put something else in place of what it does, a number of times."""

    def __init__(self, inner):
        self._inner = inner
        self._instead = {}
        self.reconnects = 0

    def instead(self, name, act, times=1, after=0):
        """Do `act(call)` in place of a method, so often, after so many calls more."""
        self._instead[name] = [act, times, after]

    def reconnect(self):
        self.reconnects += 1
        self._played("reconnect", lambda: None)()

    def _played(self, name, usual):
        def call(*given):
            if name in self._instead:
                act, times, after = self._instead[name]
                if after:
                    self._instead[name][2] -= 1
                elif times:
                    self._instead[name][1] -= 1
                    return act(lambda: usual(*given))
            return usual(*given)

        return call

    def __getattr__(self, name):
        found = getattr(self._inner, name)
        return self._played(name, found) if callable(found) else found


def fail(error):
    """Something to do instead: raise."""

    def act(_call):
        raise error

    return act


class ShakenStand:
    """Everything at hand."""

    def __init__(self, folder, programme=PROGRAMME):
        file = folder / "stand.toml"
        file.write_text(STAND, "utf-8")
        self.clock = VirtualClock(wall_start_ns=0)
        self.loaded = load_stand(file)
        made = simulation(self.loaded, self.clock)
        self.world, whole = made.world, made.stand
        self.exciter, self.daq = Wrapped(whole.exciters["exciter"]), Wrapped(whole.samplers["unit"])
        self.stand = Stand(
            name="shaken",
            positioners={},
            samplers={"unit": self.daq},
            exciters={"exciter": self.exciter},
            most=whole.most,
            quiet=whole.quiet,
            clock=self.clock,
            titles=whole.titles,
        )
        self.programme = programme_from_text(programme, "p.toml")
        self.operator, self.sink = Person(self.world.setters), MemorySink()
        self.engine = Engine(
            self.stand, self.operator, self.sink, self.programme.acquisition(samples=100, rate_hz=200.0)
        )

    def run(self):
        return self.engine.run(self.programme.procedure)

    @property
    def driven(self):
        """What really shakes."""
        return self.world.exciter.driven.text

    @property
    def warnings(self):
        return [event.message for event in self.sink.of(WarningRaised)]

    def while_shaking(self, act):
        """Do something in the dwell that is vibrated, before its samples are taken."""
        done = []

        def take(call):
            if self.driven == "sine 4 g 21.3 Hz" and not done:
                done.append(True)
                act()
            return call()

        self.daq.instead("acquire", take, times=10**6)
