"""What became of a stand file since it was read."""

from pathlib import Path

from tumble.app.stand import WrittenStand, read_stand
from tumble.messages import Message
from tumble.procedures.errors import InputError


class StandChangedError(InputError):
    """A stand file, or a Python file that it names, says something else than when it was read."""

    def __init__(self, path: Path) -> None:
        super().__init__(
            Message("{path}: was changed since it was read; read it again before anything moves", path=path)
        )
        self.path = path


def check_unchanged(stand: WrittenStand) -> None:
    """Find out whether a stand still is what its file says: its limits may be others now.

    Raises
    ------
    StandChangedError
        It says something else.
    InputError
        It cannot be read any more, as `read_stand`.
    """
    if stand.path is None:
        return
    now = read_stand(stand.path)
    if (now.sha256, now.code_sha256) != (stand.sha256, stand.code_sha256):
        raise StandChangedError(stand.path)
