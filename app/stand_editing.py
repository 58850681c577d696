"""Changing a stand file: what the loader refuses is not written, and what was there before is kept."""

import os
import secrets
import shutil
from contextlib import suppress
from datetime import datetime
from pathlib import Path

from tumble.app.stand import LoadedStand, load_stand_text
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.procedures.recording.file import synchronise_folder
from tumble.procedures.toml_lines import read_text


def save_stand(path: Path, text: str, before: str | None, now: datetime) -> LoadedStand:
    """Write a stand file at once as a whole, and keep the former one beside it as `NAME.toml.UTC`.

    Parameters
    ----------
    text
        What is written, in UTF-8.
    before
        The text that was changed; None where the file is to be new.
    now
        In UTC; it names the former file.

    Returns
    -------
    LoadedStand
        The stand of the text.

    Raises
    ------
    InputError
        The loader refuses the text; or the file is not what was changed; or there is one where it is to be new.
        Nothing was written.
    OSError
        It cannot be written; what was there is there still.
    """
    loaded = load_stand_text(text, path)
    if before is None:
        if path.exists():
            raise InputError(Message("{path}: is there already; choose another name", path=path))
    elif read_text(path) != before:
        raise InputError(
            Message("{path}: was changed by another program since it was opened here; open it anew", path=path)
        )
    place = path.resolve()
    begun = place.with_name(f".tumble-{secrets.token_hex(8)}.tmp")
    try:
        with begun.open("x", encoding="utf-8", newline="\n") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        if before is not None:
            shutil.copymode(place, begun)
            shutil.copy2(place, former_name(place, now))
        begun.replace(place)
        synchronise_folder(place.parent)
    finally:
        with suppress(OSError):
            begun.unlink(missing_ok=True)
    return loaded


def former_name(path: Path, now: datetime) -> Path:
    """Where the former one of a file is kept that is written at a moment."""
    return path.with_name(f"{path.name}.{now:%Y%m%dT%H%M%SZ}")
