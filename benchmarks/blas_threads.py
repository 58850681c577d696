"""What threads of the BLAS cost where matrices are small: tracing tables with them and without, idle and under load.

    python -m benchmarks.blas_threads
    python -m benchmarks.blas_threads --tables 6

Three simulated tables of 1,230 rows are traced in a process of their own for each line. Under load, another program
multiplies matrices on every core meanwhile.
"""

import argparse
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext

_LOAD = "import numpy as n; a = n.ones((900, 900))\nwhile True: a @ a"
_AT_MOST_S = 900.0


class _Unlimited:
    """Stands for libraries whose threads nobody limits."""

    def limit(self, limits: int) -> nullcontext[None]:  # noqa: ARG002
        return nullcontext()


def trace(tables: int, limited: bool) -> None:
    """Trace tables in this process, and print wall and processor time in seconds."""
    from benchmarks.bank import DEVELOPMENT, make_table
    from benchmarks.loop import timing
    from tumble.calibrations.core import blas_threads
    from tumble.calibrations.methods.dividing_head.loop.loop import close_loop

    cases = [make_table(job.spec, job.seed) for job in timing.wanted(DEVELOPMENT, tables)]
    if not limited:
        blas_threads._libraries = _Unlimited  # type: ignore[assignment]
    close_loop(cases[0].observations)  # imports and caches are not what is measured
    wall_s, processor_s = time.perf_counter(), time.process_time()
    for case in cases:
        close_loop(case.observations)
    print(time.perf_counter() - wall_s, time.process_time() - processor_s)


@contextmanager
def load(on: bool) -> Iterator[None]:
    """Another program on every core, or nothing."""
    environment = os.environ | {"OPENBLAS_NUM_THREADS": str(os.cpu_count())}
    other = subprocess.Popen([sys.executable, "-c", _LOAD], env=environment) if on else None
    try:
        yield
    finally:
        if other is not None:
            other.kill()
            other.wait()


def timed(tables: int, threads: str) -> tuple[float, float]:
    """Wall and processor time of tracing in a process of its own, in seconds."""
    command = [sys.executable, "-m", "benchmarks.blas_threads", "--tables", str(tables), "--trace", threads]
    environment = {name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"}
    ran = subprocess.run(command, env=environment, capture_output=True, text=True, check=True, timeout=_AT_MOST_S)
    wall_s, processor_s = map(float, ran.stdout.split())
    return wall_s, processor_s


def main() -> None:
    """Print a line for each of the four ways, and the ratios."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.blas_threads", description=__doc__)
    parser.add_argument("--tables", type=int, default=3)
    parser.add_argument("--trace", choices=("one", "all"), help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.trace:
        trace(given.tables, given.trace == "one")
        return
    for loaded in (False, True):
        with load(loaded):
            one, every = timed(given.tables, "one"), timed(given.tables, "all")
        where = "under load" if loaded else "idle"
        print(
            f"{where}: one thread {one[0]:.1f} s ({one[1]:.1f} s of processor), all threads "
            f"{every[0]:.1f} s ({every[1]:.1f} s): {every[0] / one[0]:.1f} times as long, "
            f"{every[1] / one[1]:.1f} times the processor time"
        )


if __name__ == "__main__":
    main()
