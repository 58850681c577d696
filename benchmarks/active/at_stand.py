"""The simulated stand of a case, and a copy of it without noise."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks.active.cases import DWELL_V, NOISE, Case
from benchmarks.active.oracle import Oracle
from tumble.app.acting import AtStand, measure, prepare, run_experiment
from tumble.app.joining import read_together
from tumble.app.methods.dividing_head.experiments import available
from tumble.app.stand import load_stand
from tumble.app.wiring import connect
from tumble.procedures.programmes import load_programme

_NONE = "noise_v = 0.0"


def at_stand(case: Case, folder: Path) -> tuple[AtStand, Path]:
    """The stand of a case with the first measurement made."""
    folder.mkdir()
    (folder / "stand.toml").write_text(case.stand_text, "utf-8")
    (folder / "first.toml").write_text(case.programme_text, "utf-8")
    if case.physics_text:
        (folder / "physics.py").write_text(case.physics_text, "utf-8")
    stand = load_stand(folder / "stand.toml")
    at = AtStand(stand=stand, connected=connect(stand), serial_number=f"U{case.seed}", folder=folder)
    return at, measure(at, load_programme(folder / "first.toml"))


def everything(at: AtStand, first: Path) -> dict[str, Path]:
    """The first measurement, then every experiment that the stand can run, run once, by programme."""
    runs = {"": first}
    for offer in available(at.stand, read_together([first]).observations, at.connected.attended).offers:
        prepare(at, offer)
        runs[offer.programme.name] = run_experiment(at, offer)
    return runs


class Quiet:
    """A copy of the stand of a case without noise."""

    def __init__(self, case: Case, folder: Path) -> None:
        self._effect = case.effect
        self._at, self._first = at_stand(replace(case, stand_text=case.stand_text.replace(NOISE, _NONE)), folder)

    def first(self) -> Oracle:
        """What could be told after the first programme."""
        return self._oracle({"": self._first})

    def everything(self) -> Oracle:
        """What could be told once experiments were run too."""
        return self._oracle(everything(self._at, self._first))

    def _oracle(self, runs: dict[str, Path]) -> Oracle:
        parts = [len(read_together([path]).observations) for path in runs.values()]
        rows = read_together(list(runs.values())).observations
        return Oracle(rows, np.repeat(list(runs), parts), self._effect, DWELL_V)
