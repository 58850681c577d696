"""What somebody wants to be adopted, and whether that can be."""

from dataclasses import dataclass
from pathlib import Path

from tumble.app.adopted_effects import FOLDER, adopting_of
from tumble.calibrations.adopted.effect import KeptWith
from tumble.calibrations.adopted.folder import check_effect_name, taken
from tumble.messages import Message
from tumble.procedures.errors import InputError

Key = tuple[str, str, str]
"""Channel, variable, and which of several variables of one word."""


@dataclass(frozen=True, kw_only=True)
class Wish:
    """What somebody wants to be adopted."""

    name: str
    kept_with: KeptWith
    channel: str = ""
    """Any without it."""
    variable: str = ""
    """Its word, or that with which of several it is: `acceleration`, `acceleration ax`; any without it."""
    operator: str = ""

    def wants(self, key: Key) -> bool:
        """Whether structure along an axis is meant."""
        channel, variable, detail = key
        return self.channel in ("", channel) and self.variable in ("", variable, f"{variable} {detail}".strip())


def check_wish(wish: Wish, method: str, folder: Path) -> None:
    """Find out before anything is traced whether the name is free. Raises `InputError`."""
    adopting = adopting_of(method)
    if adopting is None:
        raise InputError(Message("the method {method} says no variables on which to adopt anything", method=method))
    try:
        check_effect_name(wish.name)
    except ValueError as error:
        raise InputError(str(error)) from error
    ours = {effect.word.lower() for effect in adopting.catalogue} | {
        effect.name.lower() for effect in adopting.catalogue
    }
    if wish.name.lower() in ours:
        raise InputError(Message("{name} is an effect of the catalogue; choose another name", name=wish.name))
    if wish.name.lower() in taken(folder / FOLDER):
        raise InputError(
            Message(
                "{folder}: holds an effect {name} already, and none is written over; choose another name",
                folder=folder / FOLDER,
                name=wish.name,
            )
        )
