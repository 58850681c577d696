"""What one run says of its stand, held against what the store knows of it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from tumble.app.adopted_effects import contradicted
from tumble.app.analysed import Traced
from tumble.app.analysing import fit
from tumble.app.identity import program_identity
from tumble.app.jobs import find_job
from tumble.app.rederiving import Source, run_of, source_again, source_of
from tumble.app.stand_records import identity_of
from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.core.sentences import equals, series
from tumble.calibrations.stand_records.agreement import AGREE_P, Agreement, agreement, updated
from tumble.calibrations.stand_records.corrections import Corrections, chi_square_p
from tumble.calibrations.stand_records.record import Contribution, StandIdentity, StandRecord, Status
from tumble.calibrations.stand_records.terms import Term
from tumble.messages import Message

if TYPE_CHECKING:
    from tumble.calibrations.stand_records.store import StandRecords

_MOST_TRIED = 3
"""Of the units that said something provisional, so many are asked again, the last ones first."""


@dataclass(frozen=True, kw_only=True)
class Learned:
    """What a run changed in what is known of its stand."""

    sentences: tuple[str, ...]
    """What was found, in words."""
    record: StandRecord | None = None
    """A new version; None where there is nothing new."""


@one_blas_thread
def learn(traced: Traced, folder: Path) -> Learned:
    """Hold what a run says of its stand against the stand records of a store, and add a version where it changes them.

    A run that was corrected by a stand record teaches nothing new: it confirms that record, or contradicts it.

    Raises
    ------
    StoreError
        The store cannot be read or written.
    """
    said_of_effects = tuple(contradicted(traced))
    learned = _learn(_without_adopted(traced), folder)
    return replace(learned, sentences=(*said_of_effects, *learned.sentences))


def _without_adopted(traced: Traced) -> Traced:
    """A run as its stand record can be derived again from the raw file alone."""
    if not traced.measurement.adopted:
        return traced
    bare = fit(replace(traced.measurement, adopted=()), traced.provenance.serial_number, trials=0)
    return find_job(traced.measurement.method).trace(bare)


def _learn(traced: Traced, folder: Path) -> Learned:
    identity = identity_of(traced.measurement)
    source = source_of(traced, folder)
    if identity is None or source is None:
        return Learned(sentences=())
    if traced.measurement.stand_record is not None:
        return Learned(sentences=_stand_contradictions(traced))
    said = source.run.doubts
    if source.run.objections:
        reason = Message(
            "nothing is learned of stand {stand} from this run: {listed}",
            stand=identity.stand,
            listed=series(source.run.objections),
        )
        return Learned(sentences=(*said, reason) if source.run.terms else said)
    from tumble.calibrations.stand_records.store import StandRecords

    learned = _Stand(StandRecords(folder), identity).hear(source)
    return replace(learned, sentences=(*said, *learned.sentences))


@one_blas_thread
def contradictions_of(traced: Traced) -> tuple[str, ...]:
    """Where a run contradicts the adopted effects, or the stand record, that were applied to it, in words."""
    return (*contradicted(traced), *_stand_contradictions(traced))


def _stand_contradictions(traced: Traced) -> tuple[str, ...]:
    run, applied = run_of(traced), traced.measurement.stand_record
    return () if run is None or applied is None else tuple(run.contradictions(applied))


class _Stand:
    """One stand, and what is known of it."""

    def __init__(self, records: "StandRecords", identity: StandIdentity) -> None:
        self._records = records
        self._identity = identity
        self._known = records.find(identity)
        self._name = Message("stand {stand}", stand=identity.stand)

    def hear(self, source: Source) -> Learned:
        """What a good run changes."""
        heard = {sha for record in self._known for each in record.contributions for sha in each.raw_sha256}
        if heard & set(source.contribution.raw_sha256):
            return Learned(sentences=())
        in_force = self._records.in_force(self._identity)
        if in_force is None:
            return self._compare(source, ())
        more = source.run.estimate(in_force.corrections.terms)
        corrections, p_value = updated(in_force.corrections, more)
        if p_value < AGREE_P:
            return self._compare(source, tuple(self._against(in_force, more, p_value)))
        if beyond := in_force.corrections.without_a_place_for(source.run.terms):
            seen = series([term.label for term in beyond])
            return self._compare(
                source,
                (
                    Message(
                        "{name}: this run sees {seen}, which stand record {version} does not have",
                        name=self._name,
                        seen=seen,
                        version=in_force.version,
                    ),
                ),
            )
        if source.contribution.serial_number in in_force.units:
            return Learned(
                sentences=(
                    Message(
                        "{name}: this run agrees with stand record {version}", name=self._name, version=in_force.version
                    ),
                )
            )
        contributions = (*in_force.contributions, source.saying(more))
        return self._in_force(corrections, p_value, contributions, source, in_force)

    def _compare(self, source: Source, said: tuple[str, ...]) -> Learned:
        """Hold a run against those that said something provisional, each of another unit."""
        for record in self._provisional(source.contribution.serial_number):
            other = source_again(record.contributions[0], self._records.folder)
            if other is None:
                said += (
                    Message(
                        "stand record {version} is not used: a raw file of it is missing or changed",
                        version=record.version,
                    ),
                )
                continue
            found = agreement(other.run, source.run)
            if found.holds:
                contributions = (other.saying(found.each[0]), source.saying(found.each[1]))
                learned = self._in_force(found.corrections, found.p_value, contributions, source, record)
                return replace(learned, sentences=(*said, *learned.sentences))
            said += (self._disagreement(record, source, found),)
        if not source.run.terms:
            return Learned(sentences=said)
        estimate = source.run.estimate(source.run.terms)
        record = self._add(Status.PROVISIONAL, estimate, None, (source.saying(estimate),), source, None)
        sentence = Message(
            "{name}: {terms}: provisional (stand record {version}) until another unit agrees",
            name=self._name,
            terms=_terms(estimate),
            version=record.version,
        )
        return Learned(sentences=(*said, sentence), record=record)

    def _provisional(self, serial_number: str) -> Iterator[StandRecord]:
        """The last provisional record of every other unit since the last one in force, the newest first."""
        since = max((record.version for record in self._known if record.status is Status.IN_FORCE), default=0)
        open_ones = [record for record in self._known if record.version > since and serial_number not in record.units]
        last = {record.units[0]: record for record in open_ones}
        yield from sorted(last.values(), key=lambda record: -record.version)[:_MOST_TRIED]

    def _in_force(
        self,
        corrections: Corrections,
        p_value: float,
        contributions: Sequence[Contribution],
        source: Source,
        before: StandRecord,
    ) -> Learned:
        record = self._add(Status.IN_FORCE, corrections, p_value, contributions, source, before)
        sentence = Message(
            "{name}: units {listed} agree (p {probability}) on {terms}: stand record {version} is in force",
            name=self._name,
            listed=series(record.units),
            probability=equals(p_value),
            terms=_terms(corrections),
            version=record.version,
        )
        return Learned(sentences=(sentence,), record=record)

    def _add(
        self,
        status: Status,
        corrections: Corrections,
        p_value: float | None,
        contributions: Sequence[Contribution],
        source: Source,
        before: StandRecord | None,
    ) -> StandRecord:
        validity = source.run.validity(source.contribution.measured_at)
        return self._records.add(
            identity=self._identity,
            status=status,
            corrections=corrections,
            contributions=contributions,
            agreement_p=p_value,
            validity=validity.together(before.validity) if before else validity,
            program_version=program_identity().version,
        )

    def _against(self, record: StandRecord, more: Corrections, p_value: float) -> Iterator[str]:
        yield (
            Message(
                "{name}: this run contradicts stand record {version} (p {probability}), which stays in force; measure "
                "another unit, and where the two agree a new record takes its place",
                name=self._name,
                version=record.version,
                probability=equals(p_value),
            )
        )
        for term in _differing(record.corrections, more):
            yield Message(
                "stand record {version} says {value}, this run says {other}",
                version=record.version,
                value=record.corrections.text(term),
                other=more.text(term),
            )

    def _disagreement(self, record: StandRecord, source: Source, found: Agreement) -> str:
        units = series([record.units[0], source.contribution.serial_number])
        if not found.corrections.terms:
            return Message(
                "{name}: units {units} confirm nothing of each other: nothing is in force on their word",
                name=self._name,
                units=units,
            )
        words = Message.joined(
            "; ",
            (
                Message("{value} and {other}", value=found.each[0].text(term), other=found.each[1].text(term))
                for term in found.corrections.terms
            ),
        )
        return Message(
            "{name}: units {units} disagree (p {probability}): {words}; nothing is in force on their word",
            name=self._name,
            units=units,
            probability=equals(found.p_value),
            words=words,
        )


def _differing(known: Corrections, more: Corrections) -> Iterator[Term]:
    """Terms that two estimates put where they cannot both be."""
    for term in more.terms:
        here, there = more.place(term), known.place(term)
        spread = more.covariance[here, here] + known.covariance[there, there]
        if chi_square_p(more.values[here] - known.values[there], spread) < AGREE_P:
            yield term


def _terms(corrections: Corrections) -> str:
    return series([corrections.text(term) for term in corrections.terms])
