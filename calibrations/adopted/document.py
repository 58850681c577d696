"""Adopted effects as JSON (`tumble.adopted-effect/1`), with a hash over all of it."""

from collections.abc import Mapping
from dataclasses import asdict, replace
from typing import Any, Final

import numpy as np

from tumble.calibrations.adopted.curve import Curve
from tumble.calibrations.adopted.effect import AdoptedEffect, KeptWith, OfStand, UnitSeen, UnitType
from tumble.calibrations.adopted.knots import Knots
from tumble.calibrations.core.provenance import Source
from tumble.calibrations.records.canonical import canonical_sha256, plain
from tumble.calibrations.records.times import read_time, utc_text
from tumble.calibrations.stand_records.record import StandIdentity
from tumble.messages import Message

SCHEMA: Final = "tumble.adopted-effect/1"
_HASH: Final = "content_sha256"


def document(effect: AdoptedEffect) -> dict[str, Any]:
    """The effect with its hash."""
    return hashed(_content(effect))


def sealed(effect: AdoptedEffect) -> AdoptedEffect:
    """The effect with its hash."""
    return replace(effect, content_sha256=document(effect)[_HASH])


def effect_from(content: Mapping[str, Any]) -> AdoptedEffect:
    """Undo `document`.

    Raises
    ------
    ValueError
        What is wrong with it, as a part of a sentence.
    """
    check(content, SCHEMA)
    try:
        return _effect(content)
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise ValueError(Message("{key} is missing or is not what it should be", key=error)) from error


def hashed(content: Mapping[str, Any]) -> dict[str, Any]:
    """Content with the hash of its canonical spelling."""
    content = plain(content)
    return content | {_HASH: canonical_sha256(content)}


def check(content: object, schema: str) -> None:
    """Raise `ValueError` for content that is not of a schema, or not what was hashed: a part of a sentence."""
    if not isinstance(content, Mapping) or not str(content.get("schema", "")).startswith(
        schema.rpartition("/")[0] + "/"
    ):
        raise ValueError(Message("it is no {schema}", schema=schema.rpartition("/")[0]))
    if content["schema"] != schema:
        raise ValueError(
            Message("it is of schema {schema}, which this program does not know", schema=content["schema"])
        )
    if canonical_sha256({key: value for key, value in content.items() if key != _HASH}) != content.get(_HASH):
        raise ValueError(Message("it was altered or damaged since it was written: its hash does not fit"))


def _content(effect: AdoptedEffect) -> dict[str, Any]:
    curve = effect.curve
    return {
        "schema": SCHEMA,
        "name": effect.name,
        "method": effect.method,
        "kept_with": _kept_json(effect.kept_with),
        "channel": effect.channel,
        "variable": effect.variable,
        "detail": effect.detail,
        "depends_on": effect.depends_on,
        "also_possible": [{"channel": channel, "variable": variable} for channel, variable in effect.also_possible],
        "curve": {
            "unit": effect.channel_unit,
            "variable_unit": effect.variable_unit,
            "kernel": effect.kernel,
            "period": curve.knots.period,
            "ordered": curve.knots.ordered,
            "knots": curve.knots.places.tolist(),
            "values": curve.values.tolist(),
            "covariance": curve.covariance.tolist(),
        },
        "fall_of_deviance": effect.gain,
        "spread": effect.spread,
        "units": [asdict(unit) for unit in effect.units],
        "operator": effect.operator,
        "adopted_at": utc_text(effect.adopted_at),
        "program_version": effect.program_version,
    }


def _kept_json(kept_with: KeptWith) -> dict[str, Any]:
    if isinstance(kept_with, UnitType):
        return {"unit_type": kept_with.name}
    return {"stand": asdict(kept_with.identity)}


def _kept_with(content: Mapping[str, Any]) -> KeptWith:
    if "unit_type" in content:
        return UnitType(name=str(content["unit_type"]))
    return OfStand(identity=StandIdentity(**content["stand"]))


def _effect(content: Mapping[str, Any]) -> AdoptedEffect:
    return AdoptedEffect(
        name=str(content["name"]),
        method=content["method"],
        kept_with=_kept_with(content["kept_with"]),
        channel=content["channel"],
        variable=content["variable"],
        detail=content["detail"],
        depends_on=content["depends_on"],
        also_possible=tuple((each["channel"], each["variable"]) for each in content["also_possible"]),
        channel_unit=content["curve"]["unit"],
        variable_unit=content["curve"]["variable_unit"],
        curve=_curve(content["curve"]),
        kernel=content["curve"]["kernel"],
        gain=content["fall_of_deviance"],
        spread=content["spread"],
        units=tuple(_unit(each) for each in content["units"]),
        operator=content["operator"],
        adopted_at=read_time(content["adopted_at"]),
        program_version=content["program_version"],
        content_sha256=content[_HASH],
    )


def _curve(content: Mapping[str, Any]) -> Curve:
    places = np.array(content["knots"], dtype=float)
    knots = Knots(places=places, period=content["period"], ordered=content["ordered"])
    count = len(places)
    if not np.isfinite([*content["values"], *np.ravel(content["covariance"]), *places.ravel()]).all():
        raise ValueError("curve")
    return Curve(
        knots=knots,
        values=np.array(content["values"], dtype=float).reshape(count),
        covariance=np.array(content["covariance"], dtype=float).reshape(count, count),
    )


def _unit(content: Mapping[str, Any]) -> UnitSeen:
    sources = tuple(Source(**source) for source in content["sources"])
    return UnitSeen(**{**content, "sources": sources})
