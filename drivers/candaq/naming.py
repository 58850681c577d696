"""What a DBC file calls the messages and signals of a DAQ."""

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from cantools.database import load_string
from cantools.database.can import Database, Signal
from cantools.database.can import Message as DbcMessage
from cantools.database.errors import Error

from tumble.messages import Message

SignalNames = Mapping[str, Mapping[str, str]]
"""By message and signal as they are called here, `MESSAGE.SIGNAL` as the DBC file calls it."""

SIGNALS: Final[dict[str, tuple[str, ...]]] = {
    "Command": ("Epoch", "Samples", "Rate"),
    "Started": ("Epoch", "Samples", "Rate"),
    "Voltage": ("Voltage", "Counter", "Epoch"),
    "Identity": ("Serial", "Product", "Firmware"),
}
"""Messages of a DAQ that is told to begin, and the signals in them."""

OPTIONAL_SIGNALS: Final[dict[str, tuple[str, ...]]] = {
    "Temperature": ("Temperature", "Epoch"),
    "Time": ("Time", "Epoch"),
}
"""Messages that it may have. Every message may also have a signal named CRC, see `Checksum`."""

CRC: Final = "CRC"
_KNOWN: Final = {message: (*signals, CRC) for message, signals in (SIGNALS | OPTIONAL_SIGNALS).items()}
_MOST_OFFERED: Final = 12


@dataclass(frozen=True, kw_only=True)
class Part:
    """A message as it is called here: the message of the DBC file in which it is, and its signals there."""

    name: str
    message: DbcMessage
    signals: Mapping[str, Signal]


def read_dbc(path: Path) -> str:
    """Text of a DBC file: UTF-8 with or without a mark, or cp1252, in which most tools write.

    Raises `OSError`.
    """
    data = path.read_bytes().replace(b"\r\n", b"\n")
    for encoding in ("utf-8-sig", "cp1252"):
        with suppress(UnicodeDecodeError):
            return data.decode(encoding)
    return data.decode("latin-1")


def load_dbc(path: Path, strict: bool) -> Database:
    """Read a DBC file; a `strict` one may have no signals that overlap or jut out. Raises `OSError`, `ValueError`."""
    try:
        database = load_string(read_dbc(path), "dbc", strict=strict)
    except Error as error:
        raise ValueError(Message("{path} is no DBC file ({error})", path=path, error=error)) from error
    assert isinstance(database, Database)
    return database


def own_parts(database: Database) -> list[Part]:
    """Parts of a DBC file that uses the names in `SIGNALS`. Raises `ValueError` where it lacks one."""
    messages = {message.name: message for message in database.messages}
    missing = next((name for name in SIGNALS if name not in messages), None)
    if missing:
        raise ValueError(
            Message(
                "the DBC file has no message {missing}; see the one that comes along for all names, or write "
                "in [daq.signals] what it calls them; it has {offered}",
                missing=missing,
                offered=_offered(messages),
            )
        )
    return [
        _part(messages[name], {signal: signal for signal in signals}, name)
        for name, signals in (SIGNALS | OPTIONAL_SIGNALS).items()
        if name in messages
    ]


def named_parts(database: Database, names: SignalNames) -> list[Part]:
    """Parts of a DBC file with names of its own. Raises `ValueError` with what is missing and what there is."""
    _check_keys(names)
    messages = {message.name: message for message in database.messages}
    return [_named_part(name, signals, messages) for name, signals in names.items()]


def _check_keys(names: SignalNames) -> None:
    """Make sure that everything that is needed is named, and nothing that is not known."""
    for name, signals in names.items():
        if unknown := sorted(set(signals) - set(_KNOWN.get(name, ()))):
            known = ", ".join(f"{message}.{signal}" for message in _KNOWN for signal in _KNOWN[message])
            raise ValueError(
                Message(
                    "[daq.signals] names {name}.{unknown}, and there may be {known}",
                    name=name,
                    unknown=unknown[0],
                    known=known,
                )
            )
    told = "Command" in names or "Started" in names
    needed = SIGNALS if told else {"Voltage": ("Voltage",)}
    missing = [f"{name}.{s}" for name, signals in needed.items() for s in signals if s not in names.get(name, {})]
    if missing:
        why = Message("a DAQ that is told to begin needs it") if told else Message("it is what is measured")
        raise ValueError(
            Message("[daq.signals] does not say which signal is {missing}; {why}", missing=missing[0], why=why)
        )


def _named_part(name: str, signals: Mapping[str, str], messages: Mapping[str, DbcMessage]) -> Part:
    places = {signal: place.rpartition(".")[::2] for signal, place in signals.items()}
    for signal, (message, _) in places.items():
        if message not in messages:
            said = f"{name}.{signal} = {signals[signal]!r}"
            raise ValueError(
                Message(
                    "[daq.signals] {said}: the DBC file has no such message; it has {offered}",
                    said=said,
                    offered=_offered(messages),
                )
            )
    if len(found := sorted({message for message, _ in places.values()})) > 1:
        raise ValueError(
            Message(
                "[daq.signals] {name} is in the messages {found}; it must be in one",
                name=name,
                found=Message("{first} and {last}", first=", ".join(found[:-1]), last=found[-1]),
            )
        )
    if not found:
        raise ValueError(
            Message(
                "[daq.signals] {name} names no signal; write MESSAGE.SIGNAL of the DBC file, or leave it out", name=name
            )
        )
    return _part(messages[found[0]], {signal: there for signal, (_, there) in places.items()}, name)


def _part(message: DbcMessage, names: Mapping[str, str], name: str) -> Part:
    present = {signal.name: signal for signal in message.signals}
    for there in names.values():
        if there not in present:
            raise ValueError(
                Message(
                    "message {message} of the DBC file has no signal {signal}; it has {offered}",
                    message=message.name,
                    signal=there,
                    offered=_offered(present),
                )
            )
    signals = {signal: present[there] for signal, there in names.items()}
    if all(signal == there for signal, there in names.items()) and CRC in present:
        signals[CRC] = present[CRC]
    return Part(name=name, message=message, signals=signals)


def _offered(names: Mapping[str, object]) -> str:
    """Some names, for whoever has to choose."""
    listed = sorted(names)
    more = Message(" and {count} more", count=len(listed) - _MOST_OFFERED) if len(listed) > _MOST_OFFERED else ""
    return (", ".join(listed[:_MOST_OFFERED]) or "none") + more
