"""Tables that are not of an accelerometer: a head against a reference, parameters against temperature."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from tumble.app.files import is_recording, write_text
from tumble.app.other_console import show_comparison, show_head, show_temperature
from tumble.calibrations.core.bounded import check_bounded
from tumble.calibrations.core.cells import TableError
from tumble.calibrations.known_tables import Kind, kind_of
from tumble.calibrations.methods.head_reference.changes import compare
from tumble.calibrations.methods.head_reference.comparison_document import comparison_json
from tumble.calibrations.methods.head_reference.document import document as head_document
from tumble.calibrations.methods.head_reference.loop import close_reference_loop
from tumble.calibrations.methods.head_reference.observations import read_head_table
from tumble.calibrations.methods.temperature.document import document as temperature_document
from tumble.calibrations.methods.temperature.loop import close_temperature_loop
from tumble.calibrations.methods.temperature.table import read_runs
from tumble.procedures.errors import InputError

_MOST_COMPARED = 2


def close_other_loop(paths: Sequence[Path], show: bool, page: Path | None = None) -> dict[str, Any] | None:
    """Close the loop on tables of another kind, and say what was found; None where they are of an accelerometer.

    Two tables of one head are traced each by itself, and compared. With `page` the report on the last one is written.

    Raises
    ------
    InputError
        Unreadable or malformed, or of different kinds.
    """
    kind = kind_of_files(paths)
    if kind is Kind.ACCELEROMETER:
        return None
    try:
        return _temperature(paths, show, page) if kind is Kind.RUNS else _head(paths, show, page)
    except (TableError, ValueError) as error:
        raise InputError(str(error)) from error


def kind_of_files(paths: Sequence[Path]) -> Kind:
    """What files are tables of, all of them the same. Raises `InputError`."""
    try:
        first, *others = (_kind(path) for path in paths)
    except (TableError, ValueError) as error:
        raise InputError(str(error)) from error
    if any(other is not first for other in others):
        raise InputError(f"{paths[0]} and {paths[-1]} are tables of different kinds; give them one by one")
    return first


def _kind(path: Path) -> Kind:
    """What a file is a table of; a recording is one of an accelerometer. Raises `InputError`."""
    if is_recording(path):
        return Kind.ACCELEROMETER
    try:
        check_bounded(path)
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}); check the name and the rights") from error
    return kind_of(path)


def _temperature(paths: Sequence[Path], show: bool, page: Path | None) -> dict[str, Any]:
    if len(paths) > 1:
        raise InputError(f"{paths[1]}: give one table of parameters against temperature at a time")
    loop = close_temperature_loop(read_runs(paths[0]))
    if show:
        show_temperature(loop)
    if page is not None:
        from tumble.calibrations.report.temperature_page import render_temperature  # matplotlib takes half a second

        write_text(page, render_temperature(paths[0].name, loop))
    return temperature_document(loop)


def _head(paths: Sequence[Path], show: bool, page: Path | None) -> dict[str, Any]:
    if len(paths) > _MOST_COMPARED:
        raise InputError(f"{paths[2]}: give one table of a head, or two to be compared")
    loops = [close_reference_loop(read_head_table(path)) for path in paths]
    documents = [head_document(loop) for loop in loops]
    if show:
        for path, loop in zip(paths, loops, strict=True):
            show_head(path.name, loop)
    comparison = compare(*loops) if len(loops) > 1 else None
    if page is not None:
        from tumble.calibrations.report.head_page import render_head  # matplotlib takes half a second

        against = None if comparison is None else (paths[0].name, comparison)
        write_text(page, render_head(paths[-1].name, loops[-1], against))
    if comparison is None:
        return documents[0]
    names = (paths[0].name, paths[1].name)
    if show:
        show_comparison(comparison, *names)
    return {
        "schema": documents[0]["schema"],
        "method": documents[0]["method"],
        "tables": documents,
        **comparison_json(comparison, *names),
    }
