"""Files of samples, reduced by the method whose samples they hold."""

from pathlib import Path

from tumble.app.methods import methods
from tumble.calibrations.core.bounded import check_bounded
from tumble.calibrations.core.cells import TableError
from tumble.calibrations.core.files import read_header
from tumble.calibrations.core.reducing import Reduced, Reduces
from tumble.messages import Message
from tumble.procedures.errors import InputError


def reduced_file(file: Path) -> Reduced:
    """Reduce a file by the method whose samples it holds. Raises `InputError`."""
    try:
        check_bounded(file)
        header = read_header(file)
        for method in methods():
            if isinstance(method, Reduces) and method.are_samples(header):
                return method.reduced(file)
    except OSError as error:
        raise InputError(
            Message(
                "{path}: cannot be read ({reason}); check the name and the rights", path=file, reason=error.strerror
            )
        ) from error
    except (TableError, ValueError) as error:
        raise InputError(str(error)) from error
    raise InputError(
        Message(
            "{path}, line 1: no samples of dwells (dwell, time_s, kind, output_g); its columns are {columns}",
            path=file,
            columns=", ".join(header),
        )
    )
