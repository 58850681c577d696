"""The one place where drivers, operators and procedures are put together; drivers are imported when needed."""

import sys
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

import click

from app.instruments import HeadTable
from app.links import Links
from app.simulation import Past, simulation, switching_on
from app.stand import LoadedStand
from drivers.clock import Clock, ReleasedClock, SystemClock
from drivers.manual import Eyepiece, ManualHead
from drivers.protocols import Daq, DividingHead, Stand
from emulators.backstage import Backstage, find_backstage
from procedures.announcer import Listener
from procedures.errors import InputError
from procedures.eyepiece import OperatorEyepiece
from procedures.operator import Answers, ConsoleOperator, Operator, ScriptedOperator, SeatingOperator

ARCSEC_PER_DEG = 3600.0


@dataclass(frozen=True, kw_only=True)
class Connected:
    """A stand ready to run: instruments, whoever seats the unit, and what must hear of events for that."""

    stand: Stand
    operator: Operator
    listeners: tuple[Listener, ...] = ()
    eyepiece: OperatorEyepiece | None = None
    """The person who reads the head, where it has no motor."""
    lived_s: float | None = None
    """Since the run began that is resumed, by the clock of a stand that was put back there; None for a real one."""
    links: Links = field(default_factory=Links)
    """To be closed when the stand is no longer needed."""


def connect(
    loaded: LoadedStand,
    answers: Path | None = None,
    attended: bool = False,
    past: Past | None = None,
    clock: Clock | None = None,
) -> Connected:
    """Connect to the instruments of a stand file.

    The operator of a simulated or emulated stand is simulated too, and seats the unit whenever asked, unless an answers
    file says otherwise. An attended stand asks the person at the terminal, and lives in real time, as a real one always
    does.
    Where a run is resumed, a simulated stand lives through its `past` again first. Real instruments live by the
    computer's clock, emulated ones by any that goes as fast as theirs: `clock`.

    Raises
    ------
    InputError
        A file that the stand names cannot be used.
    DeviceError
        An instrument cannot be reached.
    """
    if loaded.file.simulates:
        return _simulated(loaded, answers, attended, past)
    clock, links = clock or SystemClock(), Links()
    try:
        daq = _daq(loaded, clock, links)
        motorised = _motorised(loaded.file.head, clock, links)
        backstage = find_backstage((loaded.file.head.address, loaded.file.daq.address))
        operator = _operator(answers, attended=attended or backstage is None)
    except BaseException:
        links.close()
        raise
    eyepiece = OperatorEyepiece(operator, clock, _tolerance_deg(loaded))
    stand = Stand(
        name=loaded.file.name,
        head=motorised or _manual(loaded, eyepiece, clock),
        daq=daq,
        clock=clock,
        serials={"head": loaded.file.head.serial, "daq": loaded.file.daq.serial},
    )
    connected = Connected(stand=stand, operator=operator, eyepiece=None if motorised else eyepiece, links=links)
    return _behind_the_scenes(connected, backstage) if backstage else connected


def _behind_the_scenes(connected: Connected, backstage: Backstage) -> Connected:
    """An emulated stand, where nobody seats the unit but who emulates it."""
    operator = SeatingOperator(connected.operator, backstage.seat)
    return replace(connected, operator=operator, listeners=(switching_on(backstage.switch_on),))


def _simulated(loaded: LoadedStand, answers: Path | None, attended: bool, past: Past | None) -> Connected:
    clock = ReleasedClock()
    simulated = simulation(loaded, clock)
    if past is not None:
        simulated = simulated.after(past)
    if attended:
        clock.release()
    operator = SeatingOperator(_operator(answers, attended), simulated.world.seat)
    stand, eyepiece = simulated.stand, None
    if loaded.file.head.driver == "manual":
        eyepiece = OperatorEyepiece(operator, clock, _tolerance_deg(loaded))
        stand = replace(stand, head=_manual(loaded, simulated.turned_by(eyepiece), clock))
    return Connected(
        stand=stand, operator=operator, listeners=simulated.listeners, eyepiece=eyepiece, lived_s=simulated.lived_s
    )


def _operator(answers: Path | None, attended: bool) -> Operator:
    if answers is not None:
        return ScriptedOperator.from_file(answers)
    if attended:
        return ConsoleOperator(sys.stdin, show=partial(click.echo, err=True))
    return ScriptedOperator(Answers(mounts={"default": "yes"}, readings={"default": ""}))


def _motorised(table: HeadTable, clock: Clock, links: Links) -> DividingHead | None:
    """The head, unless a person turns it."""
    if table.driver == "manual":
        return None
    if table.driver == "cia402":
        from drivers.cia402 import Cia402Head

        return Cia402Head(
            links.can(table),
            table.node,
            limits_deg=table.limits_deg,
            steps_per_deg=table.steps_per_deg,
            speed_deg_s=table.speed_deg_s,
            clock=clock,
        )
    from drivers.zaber import ZaberHead

    return ZaberHead(
        links.serial(table, "dividing head"),
        device=table.device,
        axis=table.axis,
        limits_deg=table.limits_deg,
        steps_per_deg=table.steps_per_deg,
        speed_deg_s=table.speed_deg_s,
        clock=clock,
    )


def _daq(loaded: LoadedStand, clock: Clock, links: Links) -> Daq:
    table = loaded.file.daq
    if table.driver == "can":
        from drivers.candaq import CanDaq, DaqFrames

        path = (loaded.path.parent if loaded.path else Path()) / table.dbc if table.dbc else None
        try:
            frames = DaqFrames.from_file(path)
        except (OSError, ValueError) as error:
            raise InputError(f"{path}: {error}; name the DBC file of the DAQ in the stand file") from error
        return CanDaq(links.can(table), frames, clock)
    from drivers.scpi import ScpiMultimeter

    return ScpiMultimeter(
        links.serial(table, "multimeter"),
        clock,
        range_v=table.range_v,
        temperature_sensor=table.temperature_sensor,
        baud_rate=table.baud_rate,
    )


def _manual(loaded: LoadedStand, eyepiece: Eyepiece, clock: Clock) -> ManualHead:
    table = loaded.file.head
    return ManualHead(eyepiece, clock, limits_deg=table.limits_deg, speed_deg_s=table.speed_deg_s, serial=table.serial)


def _tolerance_deg(loaded: LoadedStand) -> float:
    return loaded.file.head.setting_tolerance_arcsec / ARCSEC_PER_DEG
