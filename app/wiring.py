"""The one place where drivers, operators and procedures are put together."""

import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import click

from app.stand import LoadedStand
from drivers.clock import Clock, SystemClock, VirtualClock
from drivers.protocols import Stand
from drivers.simulated import HeadOptions, Simulated, SimulatedStand, build
from procedures.announcer import Listener
from procedures.errors import InputError
from procedures.events import Event, StepStarted
from procedures.operator import Answers, ConsoleOperator, Operator, ScriptedOperator, SeatingOperator
from procedures.steps import Dwell


@dataclass(frozen=True, kw_only=True)
class Connected:
    """A stand ready to run: instruments, whoever seats the unit, and what must hear of events for that."""

    stand: Stand
    operator: Operator
    listeners: tuple[Listener, ...] = ()


def connect(loaded: LoadedStand, answers: Path | None = None, attended: bool = False) -> Connected:
    """Connect to the instruments of a stand file.

    The operator of a simulated stand is simulated too, and seats the unit whenever asked, unless an answers file says
    otherwise. An attended stand asks the person at the terminal, and lives in real time.

    Raises
    ------
    InputError
        A file that the stand names cannot be used.
    """
    simulated = _simulated(loaded, SystemClock() if attended else VirtualClock())
    return Connected(
        stand=simulated.stand,
        operator=SeatingOperator(_operator(answers, attended), simulated.world.seat),
        listeners=(_switching_on(simulated.world.switch_on),),
    )


def _operator(answers: Path | None, attended: bool) -> Operator:
    if answers is not None:
        return ScriptedOperator.from_file(answers)
    if attended:
        return ConsoleOperator(sys.stdin, show=partial(click.echo, err=True))
    return ScriptedOperator(Answers(mounts={"default": "yes"}))


def _simulated(loaded: LoadedStand, clock: Clock) -> SimulatedStand:
    head = loaded.file.head
    options = HeadOptions(limits_deg=head.limits_deg, steps_per_deg=head.steps_per_deg, speed_deg_s=head.speed_deg_s)
    try:
        return build(
            loaded.file.simulated or Simulated(),
            name=loaded.file.name,
            clock=clock,
            head=options,
            base_path=loaded.path.parent if loaded.path else None,
        )
    except ValueError as error:
        raise InputError(f"{loaded.path}: {error}") from error


def _switching_on(switch_on: Callable[[], None]) -> Listener:
    """Switch the simulated unit off and on between realisations, as the published method repeats the whole test."""
    realisation = 1

    def listen(event: Event) -> None:
        nonlocal realisation
        if isinstance(event, StepStarted) and isinstance(event.step, Dwell) and event.step.realisation != realisation:
            realisation = event.step.realisation
            switch_on()

    return listen
