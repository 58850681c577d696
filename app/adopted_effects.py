"""Adopted effects of a store: which ones belong to a measurement, and what a run says against them."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from tumble.app.analysed import Analysed, Traced
from tumble.app.jobs import find_job
from tumble.app.measurement import Measurement
from tumble.app.stand_records import identity_of, with_stand_record
from tumble.calibrations.adopted.contradicting import contradictions
from tumble.calibrations.adopted.effect import AdoptedEffect, OfStand
from tumble.calibrations.adopted.folder import Kept, kept, kept_in
from tumble.calibrations.adopted.offered import Adopting, axis_of
from tumble.calibrations.records.errors import RecordError
from tumble.messages import Message
from tumble.procedures.errors import InputError

FOLDER = "effects"
"""Of a store."""


def adopting_of(method: str) -> Adopting[Any] | None:
    """What a method declares so that effects can be adopted in its tables; None where it declares nothing."""
    adopting: Adopting[Any] | None = getattr(find_job(method), "adopting", None)
    return adopting


def with_what_is_known(measurement: Measurement, folder: Path | None, effects: Path | None = None) -> Measurement:
    """A measurement corrected by the stand record in force, with the adopted effects that are sought in it.

    Parameters
    ----------
    measurement
        The raw file.
    folder
        Store of both; None where there is none.
    effects
        A file or a folder of adopted effects in place of those of the store.

    Raises
    ------
    InputError
        The stand file in it does not fit; an adopted effect is broken, or is none of its method.
    StoreError
        The store cannot be read.
    """
    return with_adopted(with_stand_record(measurement, folder), folder, effects)


def with_adopted(measurement: Measurement, folder: Path | None, effects: Path | None = None) -> Measurement:
    """The same, rows left as they are."""
    if effects is not None:
        return replace(measurement, adopted=_named(effects, measurement))
    if folder is None or adopting_of(measurement.method) is None:
        return measurement
    found = [each.effect for each in read_kept(folder / FOLDER) if each.in_force]
    return replace(measurement, adopted=tuple(each for each in found if belongs(each, measurement)))


def belongs(effect: AdoptedEffect, measurement: Measurement) -> bool:
    """Whether an effect is kept with the unit type or the stand of a measurement, and is of its method."""
    if effect.method != measurement.method:
        return False
    if isinstance(effect.kept_with, OfStand):
        return effect.kept_with.identity == identity_of(measurement)
    programme = measurement.programme
    return programme is not None and programme.unit_type == effect.kept_with.name


def _named(place: Path, measurement: Measurement) -> tuple[AdoptedEffect, ...]:
    """Effects of a file, a folder or a store, that are in force, whatever they are kept with. Raises `InputError`."""
    folder = place / FOLDER if (place / FOLDER).is_dir() else place
    found = [each for each in read_kept(folder) if each.effect.method == measurement.method]
    in_force = tuple(each.effect for each in found if each.in_force)
    if not in_force:
        raise InputError(
            Message(
                "{place}: holds no adopted effect of the method {method} that is in force; list what there is with "
                "tumble effects list",
                place=place,
                method=measurement.method,
            )
        )
    return in_force


def read_kept(place: Path) -> tuple[Kept, ...]:
    """Effects of a file or of a folder, none where there is no such folder. Raises `InputError`."""
    try:
        return (kept(place),) if place.is_file() else kept_in(place)
    except ValueError as error:
        raise InputError(str(error)) from error


def as_offered(measurement: Measurement, references: Sequence[Mapping[str, Any]], folder: Path) -> Measurement:
    """A measurement with the adopted effects that were offered to a record, and no others. Raises `RecordError`."""
    known = {each.effect.content_sha256: each.effect for each in read_kept(folder / FOLDER)} if references else {}
    for reference in references:
        if reference["content_sha256"] not in known:
            raise RecordError(
                Message(
                    "{folder}: does not hold the adopted effect {name} that was offered to this record; restore it",
                    folder=folder / FOLDER,
                    name=reference["name"],
                )
            )
    return replace(measurement, adopted=tuple(known[each["content_sha256"]] for each in references))


def contradicted(traced: Traced) -> Iterator[Message]:
    """What a run says against the adopted effects that were sought in it, and which could not be: sentences."""
    for effect in traced.measurement.adopted:
        for what in _against(traced, effect):
            yield Message(
                "this run contradicts the adopted effect {name}: {what}; measure the unit again, and where it stays so "
                "retire the effect (tumble effects retire {name})",
                name=effect.name,
                what=what,
            )
        if traced.explained is not None and axis_of(effect, traced.explained.table.axes) is None:
            yield Message(
                "the adopted effect {name} is not sought in this run: it does not show the variable, or goes beyond "
                "where the course is known",
                name=effect.name,
            )


def adopted_json(traced: Analysed) -> dict[str, Any]:
    """What a result says of the adopted effects that were offered to it; nothing where there were none."""
    effects = traced.measurement.adopted
    if not effects:
        return {}
    return {"adopted_effects": [{**each.reference, "contradicted": list(_against(traced, each))} for each in effects]}


def _against(traced: Any, effect: AdoptedEffect) -> Iterator[Message]:  # noqa: ANN401  # traced or only fitted
    explained = getattr(traced, "explained", None)
    return iter(()) if explained is None else contradictions(explained, effect)
