"""Runs on a stand with where they come from, and stand records derived again from them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

import numpy as np

from tumble.app.analysed import Traced
from tumble.app.analysing import fit, trace
from tumble.app.job_part import StandRun
from tumble.app.jobs import find_job
from tumble.app.joining import read_together
from tumble.app.measurement import Measurement
from tumble.app.referencing import REFERENCE, run_of_reference
from tumble.calibrations.core.provenance import Provenance
from tumble.calibrations.records.raw import file_sha256, resolved_path, stored_path
from tumble.calibrations.stand_records.agreement import updated
from tumble.calibrations.stand_records.corrections import Corrections
from tumble.calibrations.stand_records.record import Contribution, StandRecord
from tumble.calibrations.stand_records.terms import Term


@dataclass(frozen=True, kw_only=True)
class Source:
    """A run with where it comes from."""

    run: StandRun
    contribution: Contribution
    """Without coefficients."""

    def saying(self, estimate: Corrections) -> Contribution:
        """The contribution with what the run says alone."""
        return replace(
            self.contribution,
            coefficients=tuple(estimate.values.tolist()),
            standard_uncertainties=tuple(np.sqrt(np.diag(estimate.covariance)).tolist()),
        )


def run_of(traced: Traced) -> StandRun | None:
    """A run as far as its stand is concerned; None where nothing was traced, or its method says nothing of stands."""
    part = find_job(traced.measurement.method).stand
    return part.run(traced) if part else None


def source_of(traced: Traced, folder: Path) -> Source | None:
    """The same with where it comes from, paths relative to the folder of the store."""
    run = run_of(traced)
    return Source(run=run, contribution=_contribution(traced.measurement, traced.provenance, folder)) if run else None


def _contribution(measurement: Measurement, origin: Provenance, folder: Path) -> Contribution:
    files = (measurement, *measurement.others)
    return Contribution(
        serial_number=origin.serial_number,
        raw_paths=tuple(stored_path(folder, file.path) for file in files),
        raw_sha256=tuple(file.sha256 for file in files),
        measured_at=origin.measured_at,
        stand=measurement.stand,
        coefficients=(),
        standard_uncertainties=(),
    )


def source_again(contribution: Contribution, folder: Path) -> Source | None:
    """A unit's run, traced again from its raw files; None where one of them is missing or changed."""
    paths = _unchanged(contribution, folder)
    if not paths:
        return None
    measurement = read_together(paths, contribution.stand)
    return source_of(trace(fit(measurement, contribution.serial_number, trials=0)), folder)


def _unchanged(contribution: Contribution, folder: Path) -> list[Path]:
    """Where the raw files lie; empty where one of them is missing or changed."""
    paths = [resolved_path(folder, path) for path in contribution.raw_paths]
    good = [
        path.is_file() and file_sha256(path) == sha256
        for path, sha256 in zip(paths, contribution.raw_sha256, strict=True)
    ]
    return paths if all(good) else []


class Rederivation:
    """Derives stand records of one store again; a raw file that several rest on is traced once."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._traced: dict[tuple[str, ...], Says | None] = {}

    def corrections(self, record: StandRecord) -> Corrections | None:
        """The corrections of a record from its raw files; None where one of them is missing or changed."""
        found = [self._run(contribution) for contribution in record.contributions]
        runs = [run for run in found if run]
        if len(runs) < len(found):
            return None
        corrections = runs[0].estimate(record.corrections.terms)
        for run in runs[1:]:
            corrections, _ = updated(corrections, run.estimate(record.corrections.terms))
        return corrections

    def _run(self, contribution: Contribution) -> "Says | None":
        if contribution.raw_sha256 not in self._traced:
            self._traced[contribution.raw_sha256] = _run_again(contribution, self._folder)
        return self._traced[contribution.raw_sha256]


class Says(Protocol):
    """Whatever a stand record can be derived from: a run of a unit, or a table of head and reference."""

    def estimate(self, terms: Sequence[Term]) -> Corrections:
        """What it says of these terms."""
        ...


def _run_again(contribution: Contribution, folder: Path) -> Says | None:
    """What a raw file says of its stand; None where it is missing or changed."""
    if contribution.serial_number != REFERENCE:
        source = source_again(contribution, folder)
        return source.run if source else None
    (path,) = _unchanged(contribution, folder) or (None,)
    return None if path is None else run_of_reference(path)
