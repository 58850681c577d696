"""The stand of a run that goes on: the same file, naming the same code, before anything of it is run."""

from collections.abc import Callable
from pathlib import Path

from tumble.app.instrument_tables import places
from tumble.app.stand import LoadedStand, WrittenStand, load_stand, read_stand
from tumble.drivers.own_file import is_remote
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.procedures.recording.recorded import Recording


def load_same_stand(
    recording: Recording, path: Path | None = None, show: Callable[[str], None] = lambda _: None
) -> LoadedStand:
    """The stand file of a run, from where it was or from `path`; nothing that it names is run before it is the same.

    Parameters
    ----------
    recording
        What there is of the run.
    path
        Where the stand file lies now; by this its owner also vouches for files of which nothing is recorded.
    show
        Called with a sentence that names the file, where only the recording does, before anything in it is run.

    Raises
    ------
    InputError
        It is another by now, or so is a Python file that it names; or it cannot be told.
    """
    place = path or _recorded_place(recording)
    written = read_stand(place, recording.header.method)
    _check_same(written, recording)
    if place and path is None:
        _check_code(written, recording)
        _check_paths(written)
        show(Message("stand file {place}, as {path} says", place=place, path=recording.path))
    loaded = load_stand(place, recording.header.method)
    _check_same(loaded, recording)
    return loaded


def _recorded_place(recording: Recording) -> Path | None:
    """Where the stand file of a run was; None for the built-in stand. A path to another computer is not followed."""
    place = recording.header.stand_path
    if is_remote(place):
        raise InputError(
            Message(
                "{path}: its stand file was at {place}, which leads to another computer and is not followed; "
                "give the stand file with --stand",
                path=recording.path,
                place=place,
            )
        )
    return Path(place) if place else None


def _check_same(stand: WrittenStand, recording: Recording) -> None:
    header = recording.header
    if stand.sha256 != header.stand_sha256:
        raise InputError(
            Message(
                "{value}: is not the stand file with which {path} was begun (its SHA-256 differs); give the "
                "unchanged one with --stand, or begin a new run",
                value=stand.path or "the built-in stand",
                path=recording.path,
            )
        )
    if header.stand_code_sha256 is None:
        return
    for name, code_sha256 in stand.code_sha256.items():
        if header.stand_code_sha256.get(name, "") != code_sha256:
            raise InputError(
                Message(
                    "{path}: {name} is not the file with which {recording} was begun (its SHA-256 differs); put the "
                    "unchanged one back, or begin a new run",
                    path=stand.path,
                    name=name,
                    recording=recording.path,
                )
            )


def _check_code(stand: WrittenStand, recording: Recording) -> None:
    """Make sure that a recording says what the files held that will be run."""
    if stand.code_sha256 and recording.header.stand_code_sha256 is None:
        names = Message.joined(", ", stand.code_sha256)
        raise InputError(
            Message(
                "{path}: does not say what {names} held, so that nobody can tell whether it is still the same; "
                "look at it, and give the stand file with --stand {recording}",
                path=recording.path,
                names=names,
                recording=stand.path,
            )
        )


def _check_paths(stand: WrittenStand) -> None:
    """Make sure that no file of an instrument is on another computer: the recording alone led to this stand file."""
    for place in places(stand.recorded):
        for key, value in place.table(stand.recorded).items():
            if key != "url" and isinstance(value, str) and is_remote(value):
                raise InputError(
                    Message(
                        "{path}: {where}: {key}: {value} leads to another computer and is not followed from a "
                        "recording; "
                        "give the stand file with --stand {path}",
                        path=stand.path,
                        where=place.where,
                        key=key,
                        value=value,
                    )
                )


def followed(recording: Recording) -> list[Path]:
    """The recordings that a run followed. Raises `InputError` where one was on another computer."""
    if remote := [path for path in recording.header.follows if is_remote(path)]:
        raise InputError(
            Message(
                "{path}: follows {place}, which leads to another computer and is not followed; begin a new run",
                path=recording.path,
                place=remote[0],
            )
        )
    return [Path(path) for path in recording.header.follows]
