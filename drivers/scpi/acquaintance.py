"""Getting to know a multimeter: how it can be talked to, who it is, and what it cannot do, found out by trying."""

from dataclasses import dataclass, replace
from typing import Final

from tumble.drivers.clock import Clock
from tumble.drivers.errors import DeviceError, LinkLostError, NoReplyError
from tumble.drivers.protocols import Identity
from tumble.drivers.scpi.codec import TERMINATOR, CorruptReplyError, parse_number, parse_readings
from tumble.drivers.scpi.dialects import Dialect
from tumble.drivers.scpi.exchange import ATTEMPTS, CompoundExchange, Exchange, Link
from tumble.drivers.scpi.measurement import Setting, setting, voltage, written
from tumble.drivers.scpi.models import SCANNERS, UNKNOWN, Model, known
from tumble.drivers.scpi.plain import PlainExchange, answered
from tumble.drivers.scpi.taking import same
from tumble.messages import Message

DEVICE: Final = Message("multimeter")
USUAL_LINE_HZ: Final = 50.0
"""Where the frequency of the power line cannot be asked: at 60 Hz integration is shorter, and of whole cycles, too."""
TRIAL_PATIENCE: Final = 2
"""So often silent, and it does not answer this query; an answer that only came to harm is asked for as ever."""
TRIAL_HZ: Final = 10.0
TRIAL_READINGS: Final = 2


@dataclass(frozen=True, kw_only=True)
class Acquaintance:
    """A multimeter of which is known what it can."""

    exchange: Exchange
    identity: Identity
    """With remarks on what it cannot."""
    model: Model
    """Its dialect is left with what it understands."""
    line_hz: float


def acquaint_with_scanner(link: Link, timeout_s: float) -> Acquaintance:
    """Find out which scanner is there; it must take several queries in one message. Raises as `acquaint`."""
    if not link.checksummed:
        link.write(b"SYST:REM" + TERMINATOR)
    exchange = CompoundExchange(link, DEVICE, timeout_s)
    exchange.ask(commands=("ABOR", "*CLS"))
    identity = exchange.identify()
    model = known(identity, SCANNERS)
    return Acquaintance(exchange=exchange, identity=identity, model=model, line_hz=_line_hz(exchange, model.dialect))


def acquaint(link: Link, clock: Clock, timeout_s: float, range_v: float | None, *, common: bool) -> Acquaintance:
    """Find out who is there and what it can; errors of the past are forgotten.

    Parameters
    ----------
    range_v
        In which range it is tried.
    common
        Whether it is used by the SCPI that all have, whatever it is.

    Raises
    ------
    DeviceError
        It is not known by name, lacks what nobody can do without, or gives no answer that can be believed.
    NoReplyError, LinkLostError
        It does not answer, or the way to it is gone.
    """
    if not link.checksummed:
        link.write(b"SYST:REM" + TERMINATOR)  # an older meter obeys a serial line only after this
    plain = PlainExchange(link, DEVICE, timeout_s)
    compound = None if common else _all_at_once(CompoundExchange(link, DEVICE, timeout_s), plain)
    identity = (compound or plain).identify()
    model = UNKNOWN if common else known(identity)
    if compound and model.dialect.compound:
        line_hz = _line_hz(compound, model.dialect)
        return Acquaintance(exchange=compound, identity=identity, model=model, line_hz=line_hz)
    if compound:
        plain.identify()
    return _Trial(plain, clock, model, range_v).result(identity, link.checksummed)


def _all_at_once(compound: CompoundExchange, plain: PlainExchange) -> CompoundExchange | None:
    """The exchange if the meter takes several queries in one message; nothing where it answers to one only."""
    compound.patience = TRIAL_PATIENCE
    try:
        compound.ask(commands=("ABOR", "*CLS"))
    except LinkLostError:
        raise
    except DeviceError as error:
        try:
            plain.identify()
        except LinkLostError:
            raise
        except DeviceError:
            raise error from None
        return None
    compound.patience = ATTEMPTS
    return compound


def _line_hz(exchange: Exchange, dialect: Dialect) -> float:
    if not dialect.line_hz:
        return USUAL_LINE_HZ
    (field,) = exchange.ask(dialect.line_hz)
    try:
        return parse_number(field)
    except CorruptReplyError as error:
        happened = Message("says that its power line has {answer} Hz", answer=field)
        raise DeviceError(DEVICE, happened, Message("check that it speaks SCPI as a 34461A does")) from error


class _Trial:
    """Tries, on a meter that takes one query a message, everything that a block of readings needs."""

    def __init__(self, exchange: PlainExchange, clock: Clock, model: Model, range_v: float | None) -> None:
        self._exchange = exchange
        self._clock = clock
        self._model = model
        self._range_v = range_v
        self._remarks: list[str] = []

    def result(self, identity: Identity, checksummed: bool) -> Acquaintance:
        self._exchange.patience = TRIAL_PATIENCE
        self._find_marks()
        self._find_error_queue()
        self._choose_language()
        self._leave_out(prepare=tuple(filter(self._knows, self._dialect.prepare)))
        self._find_function()
        line_hz = _line_hz(self._exchange, self._dialect)
        self._try_settings(line_hz)
        self._try_reading(line_hz, checksummed)
        self._exchange.patience = ATTEMPTS
        identity = replace(identity, remarks=tuple(self._remarks))
        return Acquaintance(exchange=self._exchange, identity=identity, model=self._model, line_hz=line_hz)

    @property
    def _dialect(self) -> Dialect:
        return self._model.dialect

    def _leave_out(self, **changes: object) -> None:
        self._model = replace(self._model, dialect=replace(self._dialect, **changes))  # type: ignore[arg-type]

    def _find_marks(self) -> None:
        if not self._exchange.number():
            self._remarks.append(
                Message("does not keep a number (*ESE); the order of its answers is told by its identity")
            )

    def _find_error_queue(self) -> None:
        self._exchange.say("*CLS")
        try:
            self._exchange.errors()
        except NoReplyError:
            if not self._exchange.answers():
                raise
            self._exchange.has_error_queue = False
            self._remarks.append(
                Message("cannot be asked for errors (SYST:ERR?); a command that it refuses is seen by reading back")
            )

    def _choose_language(self) -> None:
        for text in self._dialect.language:
            header, value = setting(text, {})
            answer = self._read_back((header, value))
            if answer is None or not same(value, answer):
                raise DeviceError(
                    DEVICE,
                    Message(
                        "speaks {answer} and not {value} ({header})",
                        answer=answer or Message("an unknown language"),
                        value=value,
                        header=header,
                    ),
                    Message("choose {value} in its menu, and switch it off and on again", value=value),
                )

    def _knows(self, command: str) -> bool:
        """Whether it takes a command without an error."""
        self._exchange.ask(commands=(command,))
        return not self._exchange.errors()

    def _read_back(self, wanted: Setting) -> str | None:
        """What a setting reads back after it was set; nothing where the meter does not know it."""
        header, value = wanted
        if not self._knows(f"{header} {written(value)}"):
            return None
        return answered(self._exchange, f"{header}?")

    def _find_function(self) -> None:
        """Ask what it measures, where that is not known to be understood."""
        if not self._dialect.singly:
            return
        answer = answered(self._exchange, self._dialect.function)
        if answer is None or answer.strip('"') not in self._dialect.functions:
            self._exchange.errors()
            self._leave_out(function="")
            self._remarks.append(Message("cannot be asked what it measures (FUNC?)"))

    def _try_settings(self, line_hz: float) -> None:
        block = voltage(self._model, line_hz, self._range_v, TRIAL_READINGS, TRIAL_HZ)
        self._exchange.ask(commands=block.configure)
        for wanted in block.settings:
            if wanted[0] in self._dialect.optional:
                answer = self._read_back(wanted)
                if answer is None or not same(wanted[1], answer):
                    self._do_without(wanted[0], answer)
        self._exchange.errors()

    def _do_without(self, header: str, answer: str | None) -> None:
        kept = tuple(text for text in self._dialect.settings if text.split(" ")[0] != header)
        self._leave_out(settings=kept)
        unknown = Message("does not know {header}, which is left as it is", header=header)
        other = Message("answers {answer} to {header}, which is left as it is", answer=answer, header=header)
        self._remarks.append(unknown if answer is None else other)

    def _try_reading(self, line_hz: float, checksummed: bool) -> None:
        """Whether readings can be asked for twice."""
        kept = self._kept(line_hz)
        if self._dialect.singly:
            self._remarks.append(Message("is used by the SCPI that all have, its readings are taken one by one"))
        if kept:
            return
        self._leave_out(keeps=False)
        if not checksummed:
            self._remarks.append(
                Message(
                    "gives every reading once only, and this line has no checksum: a digit that is garbled on the "
                    "way is not seen; connect it by network, or judge its readings by their scatter"
                )
            )

    def _kept(self, line_hz: float) -> bool:
        count = 1 if self._dialect.singly else TRIAL_READINGS
        block = voltage(self._model, line_hz, self._range_v, count, TRIAL_HZ)
        self._exchange.ask(commands=block.preparation)
        self._exchange.say(*block.begin)
        self._clock.sleep(block.duration_s)
        try:
            (field,) = self._exchange.ask(block.fetch, extra_s=block.duration_s)
            return len(parse_readings(field)) == count
        except LinkLostError:
            raise
        except (DeviceError, CorruptReplyError):
            if not self._exchange.answers():
                raise
            return False
