"""The method `triad`: three accelerometers on a two-axis stand."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tumble.calibrations.core.files import read_header
from tumble.calibrations.core.joining import joined
from tumble.calibrations.core.known_tables import misspelt
from tumble.calibrations.core.sentences import series
from tumble.calibrations.core.view import Quantity, Section
from tumble.calibrations.methods.triad.at_the_stand import loop_at
from tumble.calibrations.methods.triad.budget import TwoAxisUncertainty
from tumble.calibrations.methods.triad.document import document
from tumble.calibrations.methods.triad.entry import VERSION, entry
from tumble.calibrations.methods.triad.hand.log import output_names, read_log
from tumble.calibrations.methods.triad.hand.result import HandResult, calibrated_by_hand
from tumble.calibrations.methods.triad.loop import TriadLoop, asked_next, close_triad_loop
from tumble.calibrations.methods.triad.observations import TriadObservations, read_triad_table
from tumble.calibrations.methods.triad.quantities import QUANTITIES
from tumble.calibrations.methods.triad.sections import sections
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.tracing.loop_result import LoopResult
from tumble.messages import Message

NEEDED = ("outer_deg", "inner_deg", "u_x_V", "u_y_V", "u_z_V")
"""Columns without which a table is none of a run at a stand."""
_OUTPUT = re.compile(r"u_[xyz]_|acc\w*_[xyz]")


@dataclass(frozen=True, kw_only=True)
class TriadResult(LoopResult):
    """Tables of one triad, taken together."""

    loop: TriadLoop

    def document(self) -> dict[str, Any]:
        """The result as `tumble.loop/1`."""
        return document(self.loop)

    def entry(self) -> Entry:
        """The result as the store takes it."""
        return entry(self.loop)

    def shown(self) -> Iterator[Section]:
        """What is shown of the loop, the answer first."""
        return sections(self.loop)


@dataclass(frozen=True)
class TriadMethod:
    """Three accelerometers on a two-axis stand."""

    name: str = "triad"
    version: int = VERSION
    title: str = Message("A triad of accelerometers on a two-axis stand")
    columns: str = Message(
        "a triad on a two-axis stand (outer_deg, inner_deg, u_x_V, u_y_V, u_z_V), or its log by hand (u_x_…)"
    )
    headline: str = ""
    quantities: Mapping[str, Quantity] = field(default_factory=lambda: QUANTITIES)

    def reads(self, header: Sequence[str], numbers: Sequence[str] | None) -> bool:  # noqa: ARG002  # by names alone
        """Whether a table holds three outputs, and both angles or none."""
        return set(NEEDED) <= set(header) or _by_hand(header)

    def hint(self, header: Sequence[str], numbers: Sequence[str]) -> str:  # noqa: ARG002  # by names alone
        """What is misspelt or missing in a table that holds an angle of the stand or an output of a triad."""
        if asked := misspelt(header, [*TriadObservations.spelt()], NEEDED):
            return asked
        if not any(name in NEEDED or _OUTPUT.match(name) for name in header):
            return ""
        return Message(
            "this looks like a table of a triad, and it lacks {missing}; a log by hand has three outputs "
            "(u_x_…, u_y_…, u_z_… in one unit) and no angle",
            missing=series([name for name in NEEDED if name not in header]),
        )

    def close_loop(self, paths: Sequence[Path]) -> TriadResult | HandResult:
        """Trace tables of one triad, taken together; of a log by hand, one. Raises `TableError`, `ValueError`."""
        if _by_hand(read_header(paths[0])):
            if len(paths) > 1:
                raise ValueError(Message("{path}: give one log of a triad at a time", path=paths[1]))
            return calibrated_by_hand(read_log(paths[0]))
        rows = joined([read_triad_table(path) for path in paths], [None] * len(paths))
        return TriadResult(loop=loop_at(asked_next(close_triad_loop(rows)), TwoAxisUncertainty()))


def _by_hand(header: Sequence[str]) -> bool:
    """Whether there are three outputs in one unit, and no angle of any stand."""
    return output_names(list(header)) is not None and not any(name.endswith("_deg") for name in header)


METHOD = TriadMethod()
