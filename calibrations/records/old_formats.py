"""Records of formats 1 to 4, and what stores of version 1 leave unsaid: all of it is still read.

Format 1 had no closed loop. Up to format 2 the verdict was a word, on the declared model's values alone. Up to
format 3 there was one method, several raw files stood in one text, and records were not chained. Up to format 4 no
record named the lot of its unit.
"""

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from tumble.calibrations.core.provenance import LimitCheck, Provenance, Source
from tumble.calibrations.core.verdict import Judgement, Model, Outcome, Verdict, verdict_from_json
from tumble.calibrations.records.parameter import named
from tumble.messages import Message

JUDGED_SINCE = 3
"""The format from which on a record holds a verdict with its reasons."""
METHODS_SINCE = 4
"""The format from which on a record names its method and its sources, and is chained."""
LOTS_SINCE = 5
"""The format from which on a record names the lot of its unit."""

OLD_WORDS = {Outcome.PASS: "inside", Outcome.FAIL: "outside", Outcome.NO_LIMITS: "not judged"}
"""How older records spell what they decided."""

_RECORDING = ".mcap"
_BETWEEN = ", "
"""Between the raw files of one record, in their paths and in their hashes."""


@dataclass(frozen=True, kw_only=True)
class Unsaid:
    """What `version_1.toml` says."""

    method: str
    method_version: int
    order: list[str]
    condition: str


@cache
def unsaid() -> Unsaid:
    """What is true of everything in a store of version 1."""
    return Unsaid(**tomllib.loads(Path(__file__).with_name("version_1.toml").read_text(encoding="utf-8")))


def outcome_of(word: str) -> Outcome:
    """The outcome that a word, new or old, stands for."""
    old = {spelling: outcome for outcome, spelling in OLD_WORDS.items()}
    return old.get(word) or Outcome(word)


def verdict_of(result: Mapping[str, Any], limits: Sequence[LimitCheck]) -> Verdict:
    """What a record decided: before there were reasons, the declared model's value, whatever it rested on."""
    if "verdict" in result:
        return verdict_from_json(result["verdict"])
    return Verdict(
        judged=Model.DECLARED,
        parameters=tuple(
            Judgement(
                name=check.name,
                outcome=Outcome.PASS if check.inside else Outcome.FAIL,
                reason=Message("judged by an earlier version, by the value of the declared model alone"),
                remedy=Message("analyse it again"),
            )
            for check in limits
        ),
    )


def model_of(result: Mapping[str, Any]) -> Model:
    """The model whose values are to be used: the augmented one where the loop found something."""
    loop = result.get("loop", {})
    return Model.AUGMENTED if loop.get("effects") or loop.get("unexplained") else Model.DECLARED


def models_of(result: Mapping[str, Any]) -> dict[str, list[dict[str, Any]]]:
    """Parameters by model: `declared` and, where the loop was closed, `augmented`.

    Where a result says of which `model` its parameters are, the declared ones stand in its loop.
    """
    loop = result.get("loop")
    declared = loop["declared"] if loop and "model" in result else result
    models = {"declared": _in_order(declared["parameters"])}
    return models | ({"augmented": _in_order(loop["augmented"]["parameters"])} if loop else {})


def _in_order(parameters: Mapping[str, Mapping[str, Any]]) -> list[dict[str, Any]]:
    order = unsaid().order
    names = sorted(parameters, key=lambda name: order.index(name) if name in order else len(order))
    return named({name: parameters[name] for name in names})


def sources_of(raw_path: str, raw_sha256: str) -> tuple[Source, ...]:
    """The raw files of a record; those of several stand in one text each, which `joined` gives back."""
    hashes = raw_sha256.split(_BETWEEN)
    paths = raw_path.split(_BETWEEN, len(hashes) - 1)
    return tuple(
        Source(kind="recording" if path.endswith(_RECORDING) else "table", path=path, sha256=sha256)
        for path, sha256 in zip(paths, hashes, strict=True)
    )


def provenance_of(stored: Mapping[str, Any]) -> Provenance:
    """Provenance as a record of any format holds it."""
    content = dict(stored)
    if "sources" in content:
        return Provenance(**content | {"sources": tuple(Source(**each) for each in content["sources"])})
    sources = sources_of(content.pop("raw_path"), content.pop("raw_sha256"))
    return Provenance(**content, sources=sources)


def joined(sources: Sequence[Source]) -> dict[str, str]:
    """Undo `sources_of`."""
    return {
        "raw_path": _BETWEEN.join(source.path for source in sources),
        "raw_sha256": _BETWEEN.join(source.sha256 for source in sources),
    }
