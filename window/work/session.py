"""The stand of the window, as one object."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager, ExitStack, suppress
from copy import deepcopy
from dataclasses import dataclass
from functools import partial
from typing import Final

import numpy as np

from tumble.app.simulation import Past
from tumble.app.stand import LoadedStand
from tumble.app.stand_changes import check_unchanged
from tumble.app.stand_lock import holding
from tumble.app.wiring import Attendant, Connected, connect
from tumble.calibrations.core.sentences import series
from tumble.drivers.errors import DeviceError, LinkLostError, NoReplyError, naming
from tumble.drivers.protocols import (
    Block,
    ChannelBlock,
    EnvironmentStatus,
    Identity,
    PositionerStatus,
    Sampler,
    Stand,
)
from tumble.messages import Message
from tumble.procedures.axes import Look
from tumble.procedures.errors import InputError, StopRequestedError
from tumble.procedures.interlock import Interlock
from tumble.procedures.losses import Losses
from tumble.procedures.motion import Motion, standstill
from tumble.window.look.language import tr
from tumble.window.look.names import AIR

_TOLERANCE_DEG: Final = 0.01
_GLANCE_S: Final = 0.05
"""What a sampler may take to be read while nothing else goes on."""


@dataclass(frozen=True, kw_only=True)
class StandIdentity:
    """A stand that answers."""

    loaded: LoadedStand
    instruments: Mapping[str, Identity]
    """By name."""
    statuses: Mapping[str, PositionerStatus]
    """Of the positioners, by name."""
    warnings: tuple[str, ...]


class StandSession:
    """A stand from the moment it is chosen: its file, and its instruments while they are connected.

    There is one at a time, `StandWorker.session`: what is on screen, what a key moves and what a run measures on are
    read from it, and another stand takes its place as a whole. Everything but `loaded` belongs to the stand's thread.
    """

    def __init__(self, loaded: LoadedStand, look: Look) -> None:
        self.loaded = loaded
        self._look = look
        self._connected: Connected | None = None
        self._held = ExitStack()
        self._silent: set[str] = set()
        """Samplers that did not answer when they were looked at, since the stand was connected."""

    def is_of(self, other: LoadedStand) -> bool:
        """Whether a stand file is the one that was chosen: it lies in the same place and says the same."""
        return (_place(other), other.sha256) == (_place(self.loaded), self.loaded.sha256)

    def check_is_of(self, its: LoadedStand) -> None:
        """Raise `InputError` where a run belongs to another stand than the one that was chosen."""
        if not self.is_of(its):
            names = {"its": its.file.name, "chosen": self.loaded.file.name}
            raise InputError(
                tr("The run belongs to the stand {its}, and {chosen} is chosen: choose {its} first", **names)
            )

    @property
    def is_connected(self) -> bool:
        """Whether there are instruments."""
        return self._connected is not None

    @property
    def connected(self) -> Connected:
        """The instruments. Raises `DeviceError` where there are none."""
        if self._connected is None:
            raise DeviceError(Message("stand"), Message("is not connected"), Message("connect it first"))
        return self._connected

    @property
    def statuses(self) -> dict[str, PositionerStatus]:
        """Where the positioners are, as they read it now, by name. Raises `DeviceError`."""
        return self._statuses(self.connected.stand)

    def heeding(self, check: Callable[[], object]) -> AbstractContextManager[None]:
        """Have `check` called while an answer is awaited; it may raise. Raises as `connected`."""
        return self.connected.stand.attention.paid_to(check)

    def readings(self, check: Callable[[], object]) -> dict[str, Block | None]:
        """What the samplers read now, by name: a few samples of each that takes them within an instant.

        None of one that answers something else than samples. One that does not answer is not looked at again until the
        stand is connected anew, and a look ends with it. Raises `LinkLostError`, as `connected`, and what `check`
        raises, which is called while an answer is awaited.
        """
        tables = self.loaded.file.samplers
        quick_hz = {name: table.rate_hz for name, table in tables.items() if table.rate_hz * _GLANCE_S >= 1.0}

        def read(name: str) -> Block:
            return self._glanced_at(name).acquire(round(quick_hz[name] * _GLANCE_S), quick_hz[name])

        with self.heeding(check):
            return self._asked(quick_hz, read)

    def _asked(self, names: Iterable[str], ask: Callable[[str], Block]) -> dict[str, Block | None]:
        """What instruments answer, but those that were silent before. Raises `LinkLostError`, and as `connected`."""
        answers: dict[str, Block | None] = {}
        for name in [name for name in names if name not in self._silent]:
            try:
                with self._naming(name):
                    answers[name] = ask(name)
            except LinkLostError:
                raise
            except NoReplyError:
                self._silent.add(name)
                return answers | {name: None}
            except DeviceError:
                answers[name] = None
        return answers

    def _glanced_at(self, name: str) -> Sampler:
        """A sampler to look at between runs: of a simulated one a copy, world and clock with it.

        What a simulated meter reads depends on how often and when it was read before; a run is none the wiser for who
        watched.
        """
        sampler = self.connected.stand.samplers[name]
        simulated = self.loaded.sampler_drivers[name] is None
        return deepcopy(sampler) if simulated else sampler

    @property
    def climates(self) -> dict[str, Block | None]:
        """The temperature that each environment measures, by name; None of one that does not answer.

        As of `readings`, one that is silent is not looked at again. Raises likewise.
        """
        environments = self.connected.stand.environments
        return self._asked(environments, lambda name: _climate(environments[name].status()))

    @property
    def answers(self) -> bool:
        """Whether every positioner says where it is."""
        try:
            for positioner in self.connected.stand.positioners.values():
                positioner.status()
        except Exception:
            return False
        return True

    def motion(self, name: str) -> Motion:
        """Moves of a positioner. Raises `DeviceError`."""
        return self._motion(self.connected.stand, name)

    def _motion(self, stand: Stand, name: str) -> Motion:
        look = partial(self._look, name)
        return Motion(
            stand.positioners[name], stand.attentive_clock, _TOLERANCE_DEG, look=look, title=stand.title(name)
        )

    def interlock(self) -> Interlock:
        """What makes sure that nothing turns behind an open door. Raises as `connected`."""
        return Interlock(self.connected.stand, Losses(self.connected.stand.title))

    def _naming(self, name: str) -> AbstractContextManager[None]:
        """Have a fault name the instrument whose it is."""
        return naming(name, self.connected.stand.title(name))

    def connect(
        self, attendant: Attendant, past: Sequence[Past] = (), check: Callable[[], object] = lambda: None
    ) -> StandIdentity:
        """Reach the instruments, which were left before.

        `check` is called while an instrument is awaited; it may raise `StopRequestedError`, at which whatever moves is
        brought to rest. Raises `InputError`, `JobError`, `DeviceError`.
        """
        check_unchanged(self.loaded)
        with ExitStack() as stack:
            stack.enter_context(holding(self.loaded, "no unit yet", check))
            connected = connect(self.loaded, attendant=attendant, past=past, check=check)
            stack.callback(connected.links.close)
            stand = connected.stand
            try:
                with stand.attention.paid_to(check):
                    identity = self._identity(connected)
            except StopRequestedError:
                self._halt(stand)
                raise
            self._connected, self._held = connected, stack.pop_all()
            self._silent.clear()
        return identity

    def _identity(self, connected: Connected) -> StandIdentity:
        stand = connected.stand
        instruments = {}
        for name, instrument in stand.instruments.items():
            with naming(name, stand.title(name)):
                instruments[name] = instrument.identify()
        return StandIdentity(
            loaded=self.loaded,
            instruments=instruments,
            statuses=self._statuses(stand),
            warnings=connected.warnings,
        )

    def _statuses(self, stand: Stand) -> dict[str, PositionerStatus]:
        statuses = {}
        for name, positioner in stand.positioners.items():
            with naming(name, stand.title(name)):
                statuses[name] = positioner.status()
        return statuses

    def disconnect(self) -> None:
        """Leave the instruments; raises what closing them raises."""
        self._connected = None
        self._held.close()

    def halt(self) -> None:
        """Tell every positioner to stop and read its rest back. Raises `DeviceError` where that could not be read."""
        if self._connected is not None:
            self._halt(self._connected.stand)

    def _halt(self, stand: Stand) -> None:
        motions = [self._motion(stand, name) for name in stand.positioners]
        for motion in motions:
            with suppress(Exception):  # `standstill` says it again, over a link that it opens anew
                motion.brake()
        if not standstill(motions, stand.clock):
            raise DeviceError(
                series([motion.title for motion in motions], "or"),
                Message("its standstill could not be read back"),
                Message("switch it off and look at it before you touch it"),
            )


def _climate(status: EnvironmentStatus) -> Block:
    temperature_degc = np.array([status.temperature_degc])
    return ChannelBlock(channels={AIR: temperature_degc}, rate_hz=1.0, device_time_s=0.0, temperature_degc=None)


def _place(loaded: LoadedStand) -> str:
    return str(loaded.path.resolve()) if loaded.path else ""
