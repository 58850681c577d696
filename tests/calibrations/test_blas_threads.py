"""The linear algebra of the analysis runs in one BLAS thread, wherever it is called from."""

import os
import subprocess
import sys

import pytest
from loop_examples import PARTS
from tables import table
from threadpoolctl import threadpool_info, threadpool_limits

from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.methods.dividing_head import analysis
from tumble.calibrations.methods.dividing_head.analysis import analyse
from tumble.calibrations.methods.dividing_head.loop.loop import close_loop
from tumble.calibrations.tracing.effect import Effect


def threads():
    """Threads of every BLAS of this process."""
    return {library["num_threads"] for library in threadpool_info() if library["user_api"] == "blas"}


@pytest.fixture(autouse=True)
def two_threads():
    """Whatever the machine: outside the analysis a BLAS has two."""
    with threadpool_limits(limits=2, user_api="blas"):
        yield


def test_fit_runs_in_one_thread_and_puts_the_former_setting_back(monkeypatch):
    seen = []
    judge = analysis.flip_closure
    monkeypatch.setattr(analysis, "flip_closure", lambda *given: seen.append(threads()) or judge(*given))
    analyse(table(*PARTS, realisations=2), trials=0)
    assert seen == [{1}]
    assert threads() == {2}


def test_tracing_runs_in_one_thread():
    seen = []

    def no_form(scene):
        seen.append(threads())
        return ()

    watching = Effect(name="w", belongs_to="unit", symbol="w", source="here", forms=no_form, report=lambda *_: {})
    close_loop(table(*PARTS, realisations=2), effects=(watching,))
    assert set(map(frozenset, seen)) == {frozenset({1})}


def test_programs_ask_for_one_thread_before_the_blas_is_loaded():
    says = "import tumble.app.cli, os; tumble.app.cli.limit_blas_threads(); print(os.environ['OPENBLAS_NUM_THREADS'])"
    without = {name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"}
    ran = subprocess.run([sys.executable, "-c", says], env=without, capture_output=True, text=True, check=True)
    assert ran.stdout == "1\n"


def test_limit_ends_where_the_function_raises():
    @one_blas_thread
    def fails():
        raise ValueError

    with pytest.raises(ValueError):
        fails()
    assert threads() == {2}
