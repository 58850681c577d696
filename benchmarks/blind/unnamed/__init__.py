"""Effects that are in no catalogue, with forms that differ from the contract's (effects.md names what is in it)."""

from collections.abc import Mapping
from typing import Final

from benchmarks.blind.unnamed import head, motion, time, unit
from benchmarks.blind.unnamed.kind import Kind

KINDS: Final[Mapping[str, Kind]] = {kind.name: kind for part in (time, head, unit, motion) for kind in part.KINDS}

__all__ = ["KINDS", "Kind"]
