"""What a recording's header says, held against what can be known otherwise."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from tumble.app.stand import load_stand
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.procedures.recording.header import Header


def check_header(path: Path, header: Header, stand: Mapping[str, Any] | None = None) -> None:
    """Refuse a header that contradicts the hashes in it.

    Recordings of older formats have no hash of the header as a whole, but one of the programme, and one of the stand
    file: where that is the one that is built in, what the header holds of it can be compared. A file at the path that
    the header names is not looked at: a recording may come from anybody.

    Parameters
    ----------
    path
        Of the recording, for the sentence.
    header
        Its header.
    stand
        Stand file as data that is used in place of the one in the header, which is then left alone.

    Raises
    ------
    InputError
        The header was damaged or altered.
    """
    if not header.has_its_programme:
        raise InputError(
            Message(
                "{path}: the programme in its header is not the one that was run (its SHA-256 differs); restore "
                "the recording from a copy",
                path=path,
            )
        )
    if stand is not None or header.protected:
        return
    built_in = load_stand(method=header.method)
    if header.stand_sha256 == built_in.sha256 and header.stand != built_in.recorded:
        raise InputError(
            Message(
                "{path}: the stand in its header is not the one at which it was made, although it has its "
                "SHA-256: the recording was damaged; restore it from a copy",
                path=path,
            )
        )
