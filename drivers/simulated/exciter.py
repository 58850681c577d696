"""The simulated exciter: it drives as it is told, at once."""

from typing import Protocol

from tumble.drivers.excitation import REST, Excitation
from tumble.drivers.exciter_table import ExciterTable, check_excitation
from tumble.drivers.protocols import ExciterStatus, Identity


class Shaken(Protocol):
    """What the exciter drives."""

    def drive_changes(self, before: Excitation, after: Excitation) -> None:
        """Be driven otherwise from now on."""
        ...


class SimulatedExciter:
    """Fits `tumble.drivers.protocols.Exciter`."""

    def __init__(self, options: ExciterTable, shaken: Shaken) -> None:
        self.options = options
        self.excitation: Excitation = REST
        self.on = False
        self.overload = False
        self.stuck = False
        """Whether it goes on as it is, whatever it is told."""
        self._shaken = shaken

    @property
    def ramp_s(self) -> float:
        """As the stand file says."""
        return self.options.ramp_s

    @property
    def driven(self) -> Excitation:
        """What it really does to the unit."""
        return self.excitation if self.on else REST

    def identify(self) -> Identity:
        """Say that it is simulated."""
        return Identity(model="tumble simulated exciter", serial="SIM-EXCITER")

    def drive(self, excitation: Excitation) -> None:
        """Drive so from now on. Raises `LimitError` outside the limits."""
        check_excitation(self.options, excitation)
        self.set(excitation, on=excitation != REST)

    def set(self, excitation: Excitation, *, on: bool) -> None:
        """Be told what to do from now on."""
        if self.stuck:
            return
        before = self.driven
        self.excitation, self.on = excitation, on
        self._shaken.drive_changes(before, self.driven)

    def status(self) -> ExciterStatus:
        """What it does."""
        return ExciterStatus(excitation=self.excitation, on=self.on, overload=self.overload)

    def make_safe(self) -> None:
        """Drive nothing."""
        self.set(REST, on=False)
