"""The stand that exists in this process only: its operator, its past, and a head of it that a person turns."""

from collections.abc import Callable, Sequence
from copy import deepcopy
from dataclasses import dataclass, replace
from functools import reduce
from typing import Protocol

from tumble.app.stand import WrittenStand
from tumble.drivers.clock import Clock
from tumble.drivers.manual import Eyepiece
from tumble.drivers.protocols import Stand
from tumble.drivers.simulated.head import HeadOptions, SimulatedHead
from tumble.drivers.simulated.table import FIRST_WORLD
from tumble.drivers.simulated.worlds import Counted, Surroundings, World, axis_of, chamber_of, exciter_of, find_world
from tumble.drivers.tables import TITLES
from tumble.messages import Message
from tumble.procedures.acquisition import Acquisition
from tumble.procedures.announcer import Listener
from tumble.procedures.control import Control
from tumble.procedures.engine import Engine
from tumble.procedures.errors import InputError
from tumble.procedures.events import Event, PointCompleted, RunResumed, StepStarted
from tumble.procedures.operator import Answers, ScriptedOperator, SeatingOperator
from tumble.procedures.programme import Programme
from tumble.procedures.steps import Dwell


@dataclass(frozen=True, kw_only=True)
class Past:
    """A run that a stand has lived through."""

    programme: Programme
    acquisition: Acquisition
    takes: Sequence[int]
    """How often each of its points was taken."""
    began_s: float = 0.0
    """Since the first run began; not before the one before it was over."""


@dataclass(frozen=True, kw_only=True)
class Simulation:
    """A simulated stand, its world, and what must hear of a run there."""

    stand: Stand
    world: World
    listeners: tuple[Listener, ...]
    lived_s: float = 0.0
    """Since the last run began that it has lived through."""

    def hand(self, positioner: str) -> "SimulatedHand":
        """What turns a positioner that has no motor."""
        return SimulatedHand(axis_of(self.world.positioners, positioner))

    def after(self, pasts: Sequence[Past]) -> "Simulation":
        """Have the world live through runs again up to their last points, and go on from there.

        What it takes to go on with the last of them is no part of it: when that is done, the random draws are counted,
        and the drifts stand, as they were.
        """
        return reduce(lambda _, past: self._after(past), pasts, self)

    def _after(self, past: Past) -> "Simulation":
        clock = self.stand.clock
        clock.sleep(past.began_s - clock.monotonic_s())
        began_s = clock.monotonic_s()
        operator = SeatingOperator(ScriptedOperator(Answers(mounts={"default": "yes"})), self.world.setters)
        control = Control()
        moments_s: list[float] = []
        counts: list[Counted] = []

        def stop() -> None:
            moments_s.append(clock.monotonic_s())
            counts.append(deepcopy(self.world.counts))
            control.stop()

        def relive(event: Event) -> None:
            if isinstance(event, PointCompleted):
                if event.point.take < past.takes[event.point.index]:
                    control.take_again(event.point.index)
                elif event.point.index + 1 == len(past.takes):
                    stop()

        if not past.takes:
            stop()
        engine = Engine(self.stand, operator, _Nowhere(), past.acquisition, [*self.listeners, relive], control=control)
        outcome = engine.run(past.programme.procedure)
        if not moments_s and outcome.error:  # somebody interrupted the program
            raise outcome.error
        putting_back = _putting_back(self.world, clock, counts[0], moments_s[0])
        return replace(self, lived_s=moments_s[0] - began_s, listeners=(*self.listeners, putting_back))


@dataclass(frozen=True)
class SimulatedHand:
    """Turns an axis of the world by hand. Fits `Hand`."""

    axis: SimulatedHead

    def turn(self, angle_deg: float) -> None:
        """Begin to turn it."""
        self.axis.start_move(angle_deg)

    def let_go(self) -> None:
        """Leave it where it is."""
        self.axis.stop()

    def turning(self) -> bool:
        """Whether it still turns."""
        return self.axis.status().moving


def simulation(loaded: WrittenStand, clock: Clock) -> Simulation:
    """Make the simulated stand of a stand file, at the beginning of its time; every driver in it is taken as simulated.

    Raises
    ------
    InputError
        A file that the stand names cannot be used, or its world has no such instrument.
    """
    file = loaded.file
    try:
        world = world_of(loaded, clock)
        stand = Stand(
            name=file.name,
            positioners={name: axis_of(world.positioners, name) for name in file.positioners},
            samplers={name: world.meter(table.channels) for name, table in file.samplers.items()},
            environments={name: chamber_of(world, table) for name, table in file.environments.items()},
            exciters={name: exciter_of(world, table) for name, table in file.exciters.items()},
            most=file.most,
            quiet=file.quiet,
            clock=clock,
            titles=TITLES,
        )
    except ValueError as error:
        raise InputError(Message("{path}: {error}", path=loaded.path, error=error)) from error
    return Simulation(stand=stand, world=world, listeners=(switching_on(world.switch_on),))


def world_of(loaded: WrittenStand, clock: Clock) -> World:
    """The world behind a stand file. Raises `ValueError`: a file that it names cannot be used."""
    file = loaded.file
    kind = find_world(file.simulated.world if file.simulated else FIRST_WORLD)
    heads = {
        name: HeadOptions(limits_deg=table.limits_deg, steps_per_deg=table.steps_per_deg, speed_deg_s=table.speed_deg_s)
        for name, table in file.positioners.items()
    }
    surroundings = Surroundings(clock=clock, heads=heads, folder=loaded.folder)
    return kind.build(file.simulated or kind.table(), surroundings)


class _Nowhere:
    """Keeps nothing."""

    def record(self, event: Event) -> None:
        """Forget an event."""


class Hand(Protocol):
    """What turns a positioner without a motor where there is nobody, at a simulated or an emulated stand."""

    def turn(self, angle_deg: float) -> None:
        """Begin to turn the head."""
        ...

    def let_go(self) -> None:
        """Leave the head where it is."""
        ...

    def turning(self) -> bool:
        """Whether the head still turns."""
        ...


class TurningEyepiece:
    """A person whose hand turns a head that is not real to every setting. Fits `Eyepiece`."""

    def __init__(self, eyepiece: Eyepiece, hand: Hand) -> None:
        self._eyepiece = eyepiece
        self._hand = hand

    def show(self, setting_deg: float) -> None:
        """Turn the head, and have it read."""
        self._hand.turn(setting_deg)
        self._eyepiece.show(setting_deg)

    def reading_deg(self) -> float | None:
        """What is read once the head stands."""
        return None if self._hand.turning() else self._eyepiece.reading_deg()

    def withdraw(self) -> None:
        """Leave the head where it is."""
        self._hand.let_go()
        self._eyepiece.withdraw()


def _putting_back(world: World, clock: Clock, counts: Counted, lived_s: float) -> Listener:
    def listen(event: Event) -> None:
        if isinstance(event, RunResumed):
            world.put_back(counts, clock.monotonic_s() - lived_s)

    return listen


def switching_on(switch_on: Callable[[], None]) -> Listener:
    """Switch the simulated unit off and on between realisations, as the published method repeats the whole test."""
    realisation = 1

    def listen(event: Event) -> None:
        nonlocal realisation
        if isinstance(event, StepStarted) and isinstance(event.step, Dwell) and event.step.realisation != realisation:
            realisation = event.step.realisation
            switch_on()

    return listen
