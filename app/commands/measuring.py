"""What the commands that measure have in common: a job, and a stand that is ready for it."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial, wraps
from pathlib import Path
from typing import Any

import click

from tumble.app.commands import options
from tumble.app.console import warn
from tumble.app.listening import listening, nothing_typed, typed_here
from tumble.app.names import given_serial_number
from tumble.app.patience import PatientControl
from tumble.app.resuming import lived_through
from tumble.app.running import Job
from tumble.app.simulation import Past
from tumble.app.stand import LoadedStand, load_stand
from tumble.app.stand_lock import holding
from tumble.app.terminal import say
from tumble.app.wiring import Connected, connect
from tumble.messages import Message
from tumble.procedures.programme import Programme
from tumble.procedures.programmes import load_programme


@dataclass(frozen=True, kw_only=True)
class Wanted:
    """What a command line says of stand, unit and whoever is there."""

    stand_path: Path | None
    programme: str
    serial_number: str
    lot: str
    operator: str
    answers: Path | None
    attended: bool

    def asked(self) -> tuple[LoadedStand, Programme]:
        """Stand file and programme, once the serial number is seen to be one. Raises `InputError`.

        Without a stand file it is the stand that is built in for the programme's method.
        """
        given_serial_number(self.serial_number, "--serial")
        if self.stand_path is not None:
            return load_stand(self.stand_path), load_programme(self.programme)
        programme = load_programme(self.programme)
        return load_stand(None, programme.method), programme

    @contextmanager
    def connected(self, loaded: LoadedStand, after: Sequence[Path] = ()) -> Iterator[Connected]:
        """The stand for oneself, ready to run; `after` are recordings that were made there before."""
        with holding(loaded, self.serial_number):
            past = lived_through(after, loaded)
            with connected_for_a_run(loaded, self.answers, self.attended, past) as connected:
                connected.ran.extend(path.resolve() for path in after)
                yield connected


@contextmanager
def connected_for_a_run(
    loaded: LoadedStand, answers: Path | None, attended: bool, past: Sequence[Past]
) -> Iterator[Connected]:
    """The stand, ready for runs that heed their control file, and where they take time their terminal.

    Raises as `connect`.
    """
    typed = typed_here() if attended or not loaded.file.simulates else nothing_typed()
    connected = connect(loaded, answers, attended, past, typed=typed)
    try:
        warn(connected.warnings)
        if typed.is_terminal:
            say(Message("while it runs you may type: pause, continue, again, stop"), err=True)
        yield replace(connected, control=PatientControl(), hears=partial(listening, typed))
    finally:
        connected.links.close()


def measures(function: Callable[..., None]) -> Callable[..., None]:
    """Give a command the options of a job; it is called with the `Job`, the `Connected` stand and its own options."""

    @wraps(function)
    def command(wanted: Wanted, **own: object) -> None:
        loaded, programme = wanted.asked()
        job = Job(
            stand=loaded,
            programme=programme,
            serial_number=wanted.serial_number,
            lot=wanted.lot,
            operator=wanted.operator,
        )
        with wanted.connected(loaded) as connected:
            function(job, connected, **own)

    return _asking(command, options.serial_needed)


def may_measure(function: Callable[..., None]) -> Callable[..., None]:
    """Give a command the same options, none of them needed; it is called with them as `Wanted` and its own options."""
    return _asking(function, options.serial)


def _asking(function: Callable[..., None], serial: Callable[..., Any]) -> Callable[..., None]:
    @wraps(function)
    def command(**given: Any) -> None:  # noqa: ANN401  # one for every option
        wanted = {name: given.pop(name) for name in Wanted.__dataclass_fields__}
        function(Wanted(**wanted), **given)

    for option in (
        options.attended,
        options.answers,
        options.operator,
        options.lot,
        serial,
        click.option("--programme", default="seed", show_default=True, help="Name of a shipped programme, or a file."),
        options.stand,
    ):
        command = option(command)
    return command
