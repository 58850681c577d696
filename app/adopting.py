"""From unnamed to named: what several runs leave unexplained on one variable becomes an effect of one's own."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import datetime
from pathlib import Path

from tumble.app.adopted_effects import FOLDER
from tumble.app.adoption_wish import Key, Wish, check_wish
from tumble.app.analysed import Analysed, Traced
from tumble.app.analysing import fit
from tumble.app.files import write_new
from tumble.app.identity import program_identity
from tumble.app.jobs import find_job
from tumble.app.terminal import as_json
from tumble.calibrations.adopted.document import document, sealed
from tumble.calibrations.adopted.effect import AdoptedEffect, UnitSeen
from tumble.calibrations.adopted.folder import SUFFIX
from tumble.calibrations.adopted.knots import knots_of
from tumble.calibrations.adopted.seen import seen
from tumble.calibrations.adopted.shared import Shared, shared
from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.core.sentences import series
from tumble.calibrations.records.times import utc_now
from tumble.calibrations.tracing.components import Axis
from tumble.calibrations.tracing.penalties import FALSE_ALARM, NEAR, UNNAMED, of_variance
from tumble.messages import Message
from tumble.procedures.errors import InputError


@one_blas_thread
def adopt(
    wish: Wish, units: Sequence[Analysed], folder: Path, now: Callable[[], datetime] = utc_now
) -> tuple[AdoptedEffect, Path]:
    """Adopt what units leave unexplained, and keep it in the folder of a store; with it the file.

    Every unit is traced, and traced again with the effect: what has a name by then may have taken its place before.

    Parameters
    ----------
    wish
        Name, with what it is kept, and on what it depends where that is not left to the data.
    units
        Runs, each of one unit, analysed by one method.
    folder
        The store.
    now
        The clock that dates it.

    Raises
    ------
    InputError
        The name is taken, the runs show nothing of the kind, or not the same.
    JobError
        It cannot be written.
    """
    check_wish(wish, units[0].measurement.method, folder)
    traced = [_traced(unit, (), folder) for unit in units]
    key = _chosen(wish, traced)
    finders = [each for each in traced if key in _found(each)] or traced
    draft = _drafted(wish, key, finders, now)
    again = [_traced(unit, (draft,), folder) for unit in units]
    effect = _drafted(wish, key, again, now)
    _refuse_chance(effect, traced, key)
    path = folder / FOLDER / f"{wish.name}{SUFFIX}"
    write_new(path, as_json(document(effect)))
    return effect, path


def _traced(unit: Analysed, further: tuple[AdoptedEffect, ...], folder: Path) -> Traced:
    """A unit traced, with adopted effects beside those that are sought in it anyway."""
    measurement = replace(unit.measurement, adopted=(*unit.measurement.adopted, *further))
    again = fit(measurement, unit.provenance.serial_number, trials=0, folder=folder)
    return find_job(measurement.method).trace(again)


def _found(traced: Traced) -> list[Key]:
    """Axes along which a run has structure without a name that another run could have too."""
    components = traced.explained.trace.components if traced.explained else ()
    return [each.axis.key for each in components if each.axis.coordinate.recurs]


def _chosen(wish: Wish, traced: Sequence[Traced]) -> Key:
    """The axis that is meant, along which all runs together show most. Raises `InputError`."""
    found = [key for each in traced for key in _found(each) if wish.wants(key)]
    known = found or [key for key in _common(traced) if wish.channel and wish.variable and wish.wants(key)]
    if not known:
        raise InputError(
            Message(
                "{files}: no unexplained structure was found that could be adopted{so}; tumble close-loop says what "
                "there is, --channel and --variable choose",
                files=series([str(each.measurement.path) for each in traced]),
                so=Message(" on what was asked for") if wish.channel or wish.variable else "",
            )
        )
    keys = list(dict.fromkeys(known))
    return max(keys, key=lambda key: together(traced, key).gain) if len(keys) > 1 else keys[0]


def _common(traced: Sequence[Traced]) -> list[Key]:
    """Axes that all runs have, and on which a value means the same in another run."""
    each = [{axis.key for axis in _axes(run) if axis.coordinate.recurs} for run in traced]
    return sorted(set.intersection(*each))


def _axes(traced: Traced) -> tuple[Axis, ...]:
    return traced.explained.table.axes if traced.explained else ()


def _axis(traced: Traced, key: Key) -> Axis:
    """The axis of a run. Raises `InputError` where it has none."""
    axis = next((each for each in _axes(traced) if each.key == key), None)
    if axis is None:
        raise InputError(
            Message(
                "{path}: does not show the variable {variable}, or nothing was traced in it; leave it out",
                path=traced.measurement.path,
                variable=" ".join(key[1:]).strip(),
            )
        )
    return axis


def together(traced: Sequence[Traced], key: Key, name: str = "") -> Shared:
    """What runs say together of a course along an axis; `name` is that of the effect that they were traced to."""
    found = [_axis(each, key) for each in traced]
    knots = knots_of([axis.coordinate for axis in found])
    explained = [each.explained for each in traced if each.explained is not None]
    return shared([seen(each, axis, knots, name) for each, axis in zip(explained, found, strict=True)], knots)


def _drafted(wish: Wish, key: Key, traced: Sequence[Traced], now: Callable[[], datetime]) -> AdoptedEffect:
    """The effect by these runs. Raises `InputError` where they have none in common."""
    found, axis = together(traced, key, wish.name), _axis(traced[0], key)
    if not found.in_common:
        raise InputError(
            Message(
                "the units have nothing in common there: in those of the mean its sizes are {sizes}; adopt it from "
                "units that show it alike",
                sizes=series([f"{size.value:.2g}" for size in found.sizes]),
            )
        )
    others = _as_good(traced, key, wish.name, found.gain)
    return sealed(
        AdoptedEffect(
            name=wish.name,
            method=traced[0].measurement.method,
            kept_with=wish.kept_with,
            channel=key[0],
            variable=key[1],
            detail=key[2],
            depends_on=axis.coordinate.depends_on,
            also_possible=others,
            channel_unit=axis.channel.unit,
            variable_unit=axis.coordinate.unit,
            curve=found.curve,
            kernel=found.kernel,
            gain=found.gain,
            spread=found.spread,
            units=_units(traced, found),
            operator=wish.operator,
            adopted_at=now(),
            program_version=program_identity().version,
        )
    )


def _units(traced: Sequence[Traced], found: Shared) -> tuple[UnitSeen, ...]:
    """Each unit with the size that it has of what they share."""
    return tuple(
        UnitSeen(
            serial_number=each.provenance.serial_number,
            size=size.value,
            standard_uncertainty=size.standard_uncertainty,
            measured_at=each.provenance.measured_at,
            sources=each.provenance.sources,
        )
        for each, size in zip(traced, found.sizes, strict=True)
    )


def _as_good(traced: Sequence[Traced], key: Key, name: str, gain: float) -> tuple[tuple[str, str], ...]:
    """Other channels and variables that explain the runs as well."""
    others = [other for other in _common(traced) if other[:2] != key[:2]]
    near = [other for other in others if together(traced, other, name).gain > gain - NEAR]
    return tuple(dict.fromkeys(other[:2] for other in near))


def _refuse_chance(effect: AdoptedEffect, traced: Sequence[Traced], key: Key) -> None:
    """Raise `InputError` for what no run shows by itself, and all together not beyond chance."""
    needed = of_variance(FALSE_ALARM / len(_common(traced))) + UNNAMED
    if effect.gain < needed and not any(key in _found(each) for each in traced):
        raise InputError(
            Message(
                "what the runs show there is no more than chance gives: -2 ln L falls by {gain:.1f}, and {needed:.1f} "
                "is needed; measure more units",
                gain=effect.gain,
                needed=needed,
            )
        )
