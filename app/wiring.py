"""The one place where drivers, operators and procedures are put together."""

import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field, replace
from functools import cache, partial
from pathlib import Path
from typing import Final, TypeAlias

from tumble.app.guarding import CHAMBER_NEEDS, DAQ_NEEDS, EXCITER_NEEDS, HEAD_NEEDS, Made, connected
from tumble.app.simulation import Hand, Past, TurningEyepiece, simulation, switching_on
from tumble.app.stand import LoadedStand
from tumble.app.terminal import say
from tumble.drivers.attention import Attention
from tumble.drivers.clock import Clock, ReleasedClock, SystemClock
from tumble.drivers.driver import Bench, DaqDriver, HeadDriver
from tumble.drivers.errors import naming
from tumble.drivers.links.opened import Links
from tumble.drivers.manual import Eyepiece
from tumble.drivers.protocols import Environment, Exciter, Positioner, Sampler, Stand
from tumble.drivers.tables import HEAD, TITLES
from tumble.emulators.backstage import Backstage, find_backstage
from tumble.messages import Message, translatable
from tumble.procedures.announcer import Listener
from tumble.procedures.axes import Look, look_away
from tumble.procedures.control import Control
from tumble.procedures.errors import InputError
from tumble.procedures.eyepiece import OperatorEyepiece
from tumble.procedures.operator import Answers, ConsoleOperator, Operator, ScriptedOperator, SeatingOperator
from tumble.procedures.turns import Turns
from tumble.procedures.typed import Typed

_UNASKED: Final = translatable(
    "stand {stand}: is emulated, and its emulated operator confirms every mount; give "
    "--attended or --answers to decide it"
)


@dataclass(frozen=True, kw_only=True)
class Attendant:
    """Who is asked at a stand, and how fast one that is simulated lives while somebody may be waited for."""

    operator: Callable[[], Operator]
    speed: float | None = None
    """Times real time; None for a stand that takes no time at all."""
    imagined: bool = False
    """Whether nobody was named, so that whoever is asked confirms everything."""


Hears: TypeAlias = Callable[[Control, Path], AbstractContextManager[Listener]]
"""Has wishes heeded by the control of a run, by its recording, and gives what must hear of the events of the run."""


@contextmanager
def hearing_nobody(_control: Control, _recording: Path) -> Iterator[Listener]:
    """Nobody has any but who has the control."""
    yield lambda _: None


@dataclass(frozen=True, kw_only=True)
class Connected:
    """A stand ready to run: instruments, whoever seats the unit, and what must hear of events for that."""

    stand: Stand
    operator: Operator
    listeners: tuple[Listener, ...] = ()
    eyepieces: Mapping[str, OperatorEyepiece] = field(default_factory=dict)
    """The person who reads the positioners that have no motor, by their names."""
    attended: bool = False
    """Whether a person is at the stand, who can do what no instrument can."""
    lived_s: float | None = None
    """Since the run began that is resumed, by the clock of a stand that was put back there; None for a real one."""
    warnings: tuple[str, ...] = ()
    """What whoever started the run should know of it."""
    links: Links = field(default_factory=Links)
    """To be closed when the stand is no longer needed."""
    ran: list[Path] = field(default_factory=list)
    """Recordings of the runs so far, in their order: what a simulated stand lives through before it goes on."""
    control: Control = field(default_factory=Control)
    """Pauses, resumes and stops what goes on there; from any thread."""
    look: Look = look_away
    """Is shown where every positioner is on its way."""
    hears: Hears = hearing_nobody
    """Listens to who has wishes for a run, as long as it is recorded."""


def connect(
    loaded: LoadedStand,
    answers: Path | None = None,
    attended: bool = False,
    past: Sequence[Past] = (),
    clock: Clock | None = None,
    attendant: Attendant | None = None,
    check: Callable[[], object] = lambda: None,
    typed: Typed | None = None,
) -> Connected:
    """Connect to the instruments of a stand file.

    The operator of a simulated or emulated stand is simulated too, and seats the unit whenever asked, unless an answers
    file says otherwise. An attended stand asks the person at the terminal, and lives in real time, as a real one always
    does; an emulated stand lives by the clock of its emulation, or by `clock`, which goes as fast.
    Where there is an `attendant`, that is who is asked, and a simulated stand lives at the attendant's speed. Where a
    run is resumed, or others came before, a simulated stand lives through its `past` again first. `check` is called
    while an instrument is awaited, and may raise. `typed` is what the person at the terminal types.

    Raises
    ------
    InputError
        A file that the stand names cannot be used.
    DeviceError
        An instrument cannot be reached.
    """
    if loaded.file.simulates:
        return _simulated(loaded, attendant or _attendant(answers, attended, typed), past)
    backstage, attention = _backstage(loaded, check), Attention()
    links = Links(attention.check)
    clock = clock or (backstage.clock if backstage else SystemClock())
    attendant = attendant or _attendant(answers, attended or backstage is None, typed)
    operator = cache(attendant.operator)
    person = _Person(operator, clock, backstage.hand if backstage else None)
    bench = Bench(clock=clock, links=links, folder=loaded.folder, eyepiece=person.at(HEAD), check=attention.check)
    try:
        with attention.paid_to(check):
            stand = replace(_reached_stand(loaded, bench, person), attention=attention)
    except BaseException:
        links.close()
        raise
    warnings = (Message.marked(_UNASKED, stand=loaded.file.name),) if backstage and attendant.imagined else ()
    made = Connected(
        stand=stand,
        operator=operator(),
        eyepieces=person.eyepieces,
        attended=backstage is None and answers is None,
        warnings=warnings,
        links=links,
    )
    return _behind_the_scenes(made, backstage) if backstage else made


def _backstage(loaded: LoadedStand, check: Callable[[], object]) -> Backstage | None:
    """Where the stand is emulated, its backstage; never of a stand whose file has no table `simulated`."""
    if loaded.file.simulated is None:
        return None
    return find_backstage([table.address for table in loaded.file.instruments.values()], check)


def _behind_the_scenes(made: Connected, backstage: Backstage) -> Connected:
    """An emulated stand, where nobody seats the unit but who emulates it."""
    operator = SeatingOperator(made.operator, backstage.setters)
    return replace(made, operator=operator, listeners=(switching_on(backstage.switch_on),))


def _simulated(loaded: LoadedStand, attendant: Attendant, past: Sequence[Past]) -> Connected:
    clock = ReleasedClock()
    simulated = simulation(loaded, clock).after(past)
    if attendant.speed is not None:
        clock.release(attendant.speed)
    operator = SeatingOperator(attendant.operator(), simulated.world.setters)
    person = _Person(lambda: operator, clock, simulated.hand)
    bench = Bench(clock=clock, links=Links(), folder=loaded.folder, eyepiece=person.at(HEAD))
    by_hand = _positioners(loaded, bench, person)  # all others are simulated
    stand = replace(simulated.stand, positioners={**simulated.stand.positioners, **by_hand})
    return Connected(
        stand=stand,
        operator=operator,
        listeners=simulated.listeners,
        eyepieces=person.eyepieces,
        lived_s=simulated.lived_s,
    )


def obliging_operator() -> Operator:
    """Confirms every mount and every setting."""
    return ScriptedOperator(Answers(mounts={"default": "yes"}, readings={"default": ""}))


def _attendant(answers: Path | None, attended: bool, typed: Typed | None) -> Attendant:
    """Whom the options of the command line name."""
    speed = 1.0 if attended else None
    if answers is not None:
        return Attendant(operator=partial(ScriptedOperator.from_file, answers), speed=speed)
    if attended:
        return Attendant(
            operator=lambda: ConsoleOperator(typed or Typed(sys.stdin), show=partial(say, err=True)), speed=speed
        )
    return Attendant(operator=obliging_operator, imagined=True)


class _Person:
    """Reads positioners without a motor, where drivers ask for somebody who does; a terminal is listened to from then.

    A `hand` turns those that are not real.
    """

    def __init__(self, operator: Callable[[], Operator], clock: Clock, hand: Callable[[str], Hand] | None) -> None:
        self.eyepieces: dict[str, OperatorEyepiece] = {}
        self._turns = cache(lambda: Turns(operator()))
        self._clock, self._hand = clock, hand

    def at(self, name: str) -> Callable[[float], Eyepiece]:
        """The person at a positioner, once it is known how far a reading may be from its setting, in degrees."""
        return partial(self._at, name)

    def _at(self, name: str, tolerance_deg: float) -> Eyepiece:
        asker = self._turns().asker()
        called = "" if name == HEAD else name
        self.eyepieces[name] = OperatorEyepiece(asker, self._clock, tolerance_deg, called, asker.withdraw)
        return TurningEyepiece(self.eyepieces[name], self._hand(name)) if self._hand else self.eyepieces[name]


def _reached_stand(loaded: LoadedStand, bench: Bench, person: _Person) -> Stand:
    """A stand that is not simulated, with all its instruments. Raises `InputError`, `DeviceError`."""
    file = loaded.file
    positioners, samplers = _instruments(loaded, bench, person)
    return Stand(
        name=file.name,
        positioners=positioners,
        samplers=samplers,
        clock=bench.clock,
        serials={name: table.serial for name, table in file.instruments.items()},
        channels={name: table.channels for name, table in file.samplers.items() if table.channels},
        environments={name: _chamber(loaded, name, bench) for name in file.environments},
        exciters={name: _exciter(loaded, name, bench) for name in file.exciters},
        most=file.most,
        quiet=file.quiet,
        titles=TITLES,
    )


def _instruments(
    loaded: LoadedStand, bench: Bench, person: _Person
) -> tuple[dict[str, Positioner], dict[str, Sampler]]:
    """Positioners and samplers of a stand that is not simulated, by name. Raises `InputError`, `DeviceError`."""
    try:
        # the samplers first: they never need a person
        sampling = {
            name: _sampler(loaded, name, driver, bench.attentive)
            for name, driver in loaded.sampler_drivers.items()
            if driver
        }
        return _positioners(loaded, bench, person), sampling
    except ValueError as error:
        raise InputError(Message("{path}: {error}", path=loaded.path, error=error)) from error


def _positioners(loaded: LoadedStand, bench: Bench, person: _Person) -> dict[str, Positioner]:
    """The positioners that have a driver, by name."""
    drivers = {name: driver for name, driver in loaded.positioner_drivers.items() if driver}
    return {
        name: _positioner(loaded, name, driver, replace(bench, eyepiece=person.at(name)))
        for name, driver in drivers.items()
    }


def _positioner(loaded: LoadedStand, name: str, driver: HeadDriver, bench: Bench) -> Positioner:
    table = loaded.file.positioners[name]
    return _reached(name, lambda: driver.connect(table, bench), table.driver, HEAD_NEEDS)


def _chamber(loaded: LoadedStand, name: str, bench: Bench) -> Environment:
    table, driver = loaded.file.environments[name], loaded.environment_drivers[name]
    assert driver is not None, "one that is simulated has a simulated world"
    return _reached(name, lambda: driver.connect(table, bench), table.driver, CHAMBER_NEEDS)


def _exciter(loaded: LoadedStand, name: str, bench: Bench) -> Exciter:
    table, driver = loaded.file.exciters[name], loaded.exciter_drivers[name]
    assert driver is not None, "one that is simulated has a simulated world"
    return _reached(name, lambda: driver.connect(table, bench), table.driver, EXCITER_NEEDS)


def _sampler(loaded: LoadedStand, name: str, driver: DaqDriver, bench: Bench) -> Sampler:
    table = loaded.file.samplers[name]
    return _reached(name, lambda: driver.connect(table, bench), table.driver, DAQ_NEEDS)


def _reached(name: str, connect: Callable[[], Made], driver: str, needed: frozenset[str]) -> Made:
    """An instrument that is connected, by its name. Raises as `connected`."""
    title = TITLES.get(name, name)
    with naming(name, title):
        return connected(connect, driver, title, needed)
