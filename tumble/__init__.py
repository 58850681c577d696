"""Calibrates inertial sensors on a test stand, and traces what the model leaves unexplained.

What a notebook or a script uses is here; it is loaded when it is first asked for:

- `fit`, `close_loop`: what a recording or a table says; `allan`: the noise of a long still one; `reduce`: samples of
  vibrated dwells; `plan`, `run`, `calibrate`: at a stand, the built-in simulated one unless told; `records`: what was
  stored.
- `Result` shows itself in a notebook, and has `values`, `to_dict`, `to_dataframe` and `plot`, which gives a `Picture`.

Packages: `calibrations` is the analysis; `procedures` are programmes, the engine and recordings; `drivers` are
instruments; `emulators` put the protocols of real instruments before a simulated world; `app` is stand files, wiring
and the command line; `window` is the operator's window.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tumble.app.notebook import allan, calibrate, close_loop, fit, plan, records, reduce, run
    from tumble.app.notebook_result import Picture, Result

__all__ = ["Picture", "Result", "allan", "calibrate", "close_loop", "fit", "plan", "records", "reduce", "run"]


def __getattr__(name: str) -> object:
    """Load what is asked for."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from tumble.app import notebook

    return getattr(notebook, name)
