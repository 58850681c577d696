"""A multimeter at the terminals of the simulated unit."""

from collections.abc import Callable, Generator
from functools import partial
from typing import Final

from tumble.emulators.faults import Faults
from tumble.emulators.scpi.command import Command, Reply
from tumble.emulators.scpi.configuration import LINE_HZ, Configuration
from tumble.emulators.scpi.families import Families, written
from tumble.emulators.scpi.language import ScpiError, Tree, Unit, number, units
from tumble.emulators.scpi.models import MODELS, Messages
from tumble.emulators.scpi.status import Status
from tumble.emulators.scpi.triggering import Triggering
from tumble.emulators.world import SharedWorld

ALWAYS: Final = ("*", "SYST", "CMDS")
"""How what is known in every language of a Rigol meter begins."""
OTHER_SERIAL: Final = "MY57299999"
"""Serial number of the unit that takes its place with the fault `swapped`."""


class Multimeter:
    """Answers SCPI messages with what the world's voltmeter and thermometer see. Its state outlives its clients.

    It measures DC voltage and temperature. A measurement takes as long as its settings say, by the clock of the world:
    a reading the integration time (twice that with autozero) and the trigger delay, or the sample timer.

    Parameters
    ----------
    world
        Where it is wired.
    faults
        What shall go wrong in it: nan, overload, error_queued, swapped, power_loss.
    model
        One of `models.MODELS`.
    serial
        Serial number.
    messages
        What comes of several queries in one message, where that is not what the model does.
    """

    def __init__(
        self,
        world: SharedWorld,
        faults: Faults | None = None,
        model: str = "34461A",
        serial: str = "MY57200001",
        messages: Messages | None = None,
    ) -> None:
        self.lock = world.lock
        """Held by whoever lets it work."""
        self.status = Status()
        self._faults = faults or Faults()
        self._name, self._model, self._serial = model, MODELS[model], serial
        self._configuration = Configuration(self._model)
        self._messages = messages or self._model.messages
        self._triggering = Triggering(world, self._faults)
        self._families = Families(self._model, self._configuration, self._triggering, self.status)
        every = self._common() | self._system() | self._measuring()
        every |= self._configuration.commands() | self._families.commands()
        self._commands = Tree({header: command for header, command in every.items() if self._has(header)})

    @property
    def deaf(self) -> bool:
        """Whether it reads nothing but ABORt at the moment."""
        return self._model.deaf and self._triggering.busy

    def abort(self) -> None:
        """End the measurement."""
        with self.lock:
            self._triggering.abort()

    def execute(self, message: str) -> Generator[None, None, str]:
        """Carry out a message; yields while a query waits for readings, and returns the answers, separated by ";".

        What cannot be done is left out; what cannot be understood ends the message.
        """
        self._suffer()
        answers: list[str] = []
        last = False
        try:
            self._check(message)
            for unit in units(message):
                while self.deaf and not unit.header.startswith("ABOR"):
                    yield
                command = self._found(unit)
                if last and unit.header.endswith("?"):
                    raise ScpiError(-440)
                if answers and unit.header.endswith("?") and self._messages == "first":
                    raise ScpiError(-410)
                last = last or command.last
                reply = self.status.attempt(partial(command.perform, unit.parameters))
                while callable(reply):
                    if self._triggering.busy:
                        yield
                    else:
                        reply = self.status.attempt(reply)
                if reply is not None:
                    answers.append(reply)
        except ScpiError as error:
            self.status.report(error)
        if self._faults.take("error_queued"):
            self.status.report(ScpiError(-310))
        return ("\n" if self._messages == "lines" else ";").join(answers)

    def _check(self, message: str) -> None:
        """Raises `ScpiError` where it takes no such message as a whole."""
        if self._messages == "one" and message.count("?") > 1:
            raise ScpiError(-113)

    def _found(self, unit: Unit) -> Command:
        """The command of a header. Raises `ScpiError` where it is not known, or not now."""
        if self._configuration.word("command_set") in ("RIGOL", "FLUKE") and not unit.header.startswith(ALWAYS):
            raise ScpiError(-113)
        command = self._commands.find(unit.header)
        changes = not unit.header.endswith("?") and not unit.header.startswith(("*", "ABOR", "INIT"))
        if self._model.family == "siglent" and self._triggering.busy and changes:
            raise ScpiError(-221)
        return command

    def _has(self, header: str) -> bool:
        """Whether the model knows a command."""
        name = header.removesuffix("?")
        return name not in self._model.lacks and (not self._model.only or name in self._model.only)

    def _suffer(self) -> None:
        """Let happen to it what the faults say."""
        if self._faults.take("swapped"):
            self._serial = OTHER_SERIAL
        if self._faults.take("power_loss"):
            self.status.power_on()
            self._reset()

    def _common(self) -> dict[str, Command]:
        """Common commands (IEEE 488.2-1992, chapter 10)."""
        status = self.status
        return {
            "*IDN?": Command(act=self._identity, last=True),
            "*OPT?": Command(act=lambda: "0", last=True),
            "*RST": Command(act=self._reset),
            "*CLS": Command(act=status.clear),
            "*ESE": Command(act=self._enable, least=1, most=1),
            "*ESE?": Command(act=lambda: f"{status.enabled:+d}"),
            "*SRE": Command(act=self._request, least=1, most=1),
            "*SRE?": Command(act=lambda: f"{status.requests:+d}"),
            "*ESR?": Command(act=lambda: f"{status.take_events():+d}"),
            "*STB?": Command(act=lambda: f"{status.byte:+d}"),
            "*OPC": Command(act=status.complete),
            "*OPC?": Command(act=lambda: lambda: "1"),
            "*WAI": Command(act=lambda: lambda: None),
            "*TST?": Command(act=lambda: "+0"),
            "*TRG": Command(act=self._triggering.trigger),
        }

    def _system(self) -> dict[str, Command]:
        return {
            "SYSTem:ERRor[:NEXT]?": Command(act=self._error),
            "SYSTem:VERSion?": Command(act=lambda: "1994.0"),
            "SYSTem:LFRequency?": Command(act=lambda: f"{LINE_HZ:+.0f}"),
            "SYSTem:LICense:CATalog?": Command(act=lambda: '""'),
            "SYSTem:PRESet": Command(act=self._reset),
            "SYSTem:LOCal": Command(act=_stay),
            "SYSTem:REMote": Command(act=_stay),
            "SYSTem:BEEPer[:IMMediate]": Command(act=_stay),
            "ROUTe:TERMinals?": Command(act=lambda: "FRON"),
        }

    def _measuring(self) -> dict[str, Command]:
        voltage, temperature = self._configuration.configure_voltage, self._configuration.configure_temperature
        return {
            "CONFigure[:SCALar]:VOLTage[:DC]": Command(act=partial(self._change, voltage), most=2),
            "CONFigure[:SCALar]:TEMPerature": Command(act=partial(self._change, temperature), most=4),
            "MEASure[:SCALar]:VOLTage[:DC]?": Command(act=partial(self._measure, voltage), most=2),
            "MEASure[:SCALar]:TEMPerature?": Command(act=partial(self._measure, temperature), most=4),
            "[SENSe]:FUNCtion[:ON]": Command(act=partial(self._change, self._configuration.choose), least=1, most=1),
            "INITiate[:IMMediate]": Command(act=self._initiate),
            "ABORt": Command(act=self._triggering.abort),
            "FETCh?": Command(act=lambda: self._fetch),
            "READ?": Command(act=self._read),
        }

    def _change(self, change: Callable[..., None], *parameters: str) -> None:
        """What is in the memory does not belong to a new configuration."""
        self._triggering.forget()
        change(*parameters)

    def _measure(self, configure: Callable[..., None], *parameters: str) -> Reply:
        self._change(configure, *parameters)
        return self._read()

    def _read(self) -> Reply:
        if self._configuration.measurement.source == "BUS":
            raise ScpiError(-214)
        self._triggering.abort()
        self._initiate()
        return self._fetch

    def _initiate(self) -> None:
        self._triggering.initiate(self._families.measurement())
        self._families.measured()

    def _fetch(self) -> str:
        return written(self._triggering.fetch())

    def _error(self) -> str:
        entry = self.status.take_error()
        return self._model.no_error if entry == str(ScpiError(0)) else entry

    def _reset(self) -> None:
        self._configuration.reset()
        self._triggering.forget()

    def _identity(self) -> str:
        return f"{self._model.maker},{self._model.name or self._name},{self._serial},{self._model.firmware}"

    def _enable(self, mask: str) -> None:
        self.status.enabled = _mask(mask) & self._model.enable_mask

    def _request(self, mask: str) -> None:
        self.status.requests = _mask(mask)


def _mask(text: str) -> int:
    """The bits of a register. Raises `ScpiError`."""
    value = number(text)
    if not 0 <= value <= 255:
        raise ScpiError(-222)
    return round(value)


def _stay() -> None:
    """Do nothing: front panel and beeper are not emulated."""
