"""One BLAS thread while the matrices are small.

A table of a thousand rows becomes matrices of a few dozen columns. On those the threads of OpenBLAS gain nothing, and
where another program has the other core they wait for each other: tracing then takes many times as long
(docs/figures.md states the ratio). Programs of this product say so to the BLAS before it is loaded
(`tumble.app.cli`); what is called from another program limits it for the time of the call.
"""

import os
import sys
from collections.abc import Callable
from functools import cache, wraps
from threading import local
from typing import TYPE_CHECKING, ParamSpec, TypeVar

if TYPE_CHECKING:
    from threadpoolctl import ThreadpoolController

_Arguments = ParamSpec("_Arguments")
_Result = TypeVar("_Result")
_here = local()
"""What this thread has limited already: a call within a limited one need not limit anything."""


def one_blas_thread(function: Callable[_Arguments, _Result]) -> Callable[_Arguments, _Result]:
    """Return the function so that the BLAS of numpy and scipy runs in one thread while it is called.

    A BLAS has one setting for the whole process. Of several Python threads the first that limits it decides, as
    threadpoolctl says of OpenBLAS.
    """

    @wraps(function)
    def limited(*arguments: _Arguments.args, **named: _Arguments.kwargs) -> _Result:
        if getattr(_here, "limited", False):
            return function(*arguments, **named)
        _here.limited = True
        try:
            with _libraries().limit(limits=1):
                return function(*arguments, **named)
        finally:
            _here.limited = False

    return limited


def _libraries() -> "ThreadpoolController":
    """The BLAS libraries of this process.

    SciPy brings one of its own, which must be loaded to be found; where the environment asks for one thread, it will
    have one whenever it is loaded.
    """
    return _controller("scipy.linalg" in sys.modules or os.environ.get("OPENBLAS_NUM_THREADS") != "1")


@cache
def _controller(with_scipy: bool) -> "ThreadpoolController":
    from threadpoolctl import ThreadpoolController

    if with_scipy:
        import scipy.linalg  # noqa: F401
    return ThreadpoolController().select(user_api="blas")
