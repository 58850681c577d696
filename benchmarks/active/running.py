"""Closes the loop on a case, and asks an oracle, or every experiment on copies of its stand."""

import tempfile
import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from benchmarks.active import unnamed
from benchmarks.active.at_stand import Quiet, at_stand, everything
from benchmarks.active.cases import Case, make
from benchmarks.active.grading import Record, told
from tumble.app.closing import MOST_EXPERIMENTS, Closing, act, begin
from tumble.app.joining import read_together
from tumble.calibrations.methods.dividing_head.loop.loop import explain
from tumble.calibrations.tracing.stage import Stage, stage_of


@dataclass(frozen=True, kw_only=True)
class Job:
    """One case to be graded."""

    seed: int
    unnamed: bool = False
    """Whether its effect is outside the catalogue, and is to be located instead of named."""

    @property
    def key(self) -> str:
        """Its name among results on file."""
        return f"{'unnamed' if self.unnamed else 'active'} {self.seed}"

    @property
    def case(self) -> Case:
        """What is measured."""
        return unnamed.make(self.seed) if self.unnamed else make(self.seed)


def graded(job: Job) -> Record:
    """Carry out a case and grade it; one that is not ambiguous has no grade."""
    case = job.case
    record: Record = {
        "key": job.key,
        "seed": case.seed,
        "effect": unnamed.KINDS[case.effect].place if job.unnamed else case.effect,
        "kind": case.effect,
        "outside": case.outside,
        "first": case.first,
        "seat": case.seat,
        "open": True,
        "ambiguous": False,
        "failure": None,
    }
    began_s = time.perf_counter()
    try:
        with tempfile.TemporaryDirectory() as folder:
            record |= (_unnamed if job.unnamed else _named)(case, Path(folder), record)
    except Exception as error:  # whatever it is, the case counts as failed and the others are still graded
        record |= {"failure": repr(error)}
    return record | {"seconds": time.perf_counter() - began_s}


def _named(case: Case, folder: Path, _record: Record) -> Record:
    quiet = Quiet(case, folder / "quiet")
    if not quiet.first().open_to_doubt:
        return {"open": False}
    carried_out = _carried_out(case, folder)
    if not carried_out["ambiguous"]:
        return carried_out
    best, expected = quiet.everything().best(MOST_EXPERIMENTS)
    return carried_out | {"best": best, "expected": expected}


def _unnamed(case: Case, folder: Path, record: Record) -> Record:
    if not Quiet(case, folder / "quiet").first().visible:
        return {"open": False}
    record = record | _carried_out(case, folder)
    return record | _everything_told(case, folder) if record["ambiguous"] and not told(record) else record


def _carried_out(case: Case, folder: Path) -> Record:
    at, first = at_stand(case, folder / "loop")
    closing = begin([first], at)
    before = _names(closing.chain.first)
    if not any(len(names) > 1 for names in before):
        return {"ambiguous": False, "found": before}
    return {"ambiguous": True, "before": before} | _outcome(closing, act(closing, at, MOST_EXPERIMENTS))


def _outcome(begun: Closing, closing: Closing) -> Record:
    time_s = {probe.programme: probe.stand_time_s for probe in begun.available.probes}
    run = [link.experiment.programme for link in closing.chain.links]
    return {
        "experiments": run,
        "separated": [link.separated for link in closing.chain.links],
        "differences": [(link.experiment.separation, link.realised) for link in closing.chain.links],
        "stand_time_s": sum(time_s[name] for name in run),
        "everything_s": sum(time_s.values()),
        "found": _names(closing.chain.last),
        "ended": closing.chain.ended,
        "why": closing.chain.why,
    }


def _everything_told(case: Case, folder: Path) -> Record:
    """What is known once every experiment that the stand can run was run: in the noise of the case, and in another."""
    again = replace(case, stand_text=case.stand_text.replace(f"\nseed = {case.seed}", f"\nseed = {case.seed + 1}"))
    return {
        "everything_found": _after_everything(case, folder / "everything"),
        "again_found": _after_everything(again, folder / "again"),
    }


def _after_everything(case: Case, folder: Path) -> list[list[str]]:
    runs = everything(*at_stand(case, folder))
    return _names(stage_of(*explain(read_together(list(runs.values())).observations)))


def _names(stage: Stage[Any]) -> list[list[str]]:
    """What every effect could be, and on what structure without a name could live."""
    return [list(names) for names in stage.explanations]
