"""Why an experiment is to be run, or why none would help, in words."""

from collections.abc import Collection, Mapping, Sequence
from typing import Final

from tumble.calibrations.core.sentences import deviations, series
from tumble.calibrations.tracing.probe import Probe
from tumble.messages import Message

_OWNERS: Final[Mapping[str, Message]] = {
    "unit": Message("the unit"),
    "stand": Message("the stand"),
    "daq": Message("the DAQ"),
    "reference": Message("the reference"),
}
"""What an effect belongs to, in a sentence."""


def promised(probe: Probe, name: str, rivals: Sequence[str], separation: float) -> Message:
    """What an experiment changes, and by how much explanations then differ: the nearest by `separation` in -2 ln L."""
    return Message.counted(
        "{programme} {does}: {name} then differs from {rivals} by {difference}",
        "{programme} {does}: {name} then differs from {rivals} by at least {difference}",
        count=len(rivals),
        programme=probe.programme,
        does=probe.does,
        name=name,
        rivals=series(rivals),
        difference=deviations(separation),
    )


def qualified(why: Message, needed: Sequence[str], others: Sequence[str], runs: int) -> Message:
    """The same with its conditions: which explanation must be true, what must be run with it, and how often."""
    if needed:
        why = Message("{why}, if {names} is the true one", why=why, names=series(needed))
    if others:
        why = Message("{why}; only together with {programmes}", why=why, programmes=series(others))
    if runs > 1:
        why = Message("{why}; run it {runs} times", why=why, runs=runs)
    return why


def no_programme(
    name: str, rivals: Sequence[str], separation: float, owners: Collection[str], otherwise: str
) -> Message:
    """That no experiment separates explanations, by how much they differ at most, and what to do `otherwise`."""
    why = Message(
        "no programme that comes along tells {name} from {rivals}: they differ by {difference} at most",
        name=name,
        rivals=series(rivals, "or"),
        difference=deviations(separation),
    )
    if len(owners) > 1:
        exchanged = series(sorted(_OWNERS[owner] for owner in owners))
        why = Message("{why}; as they belong to {owners}, exchange one of these", why=why, owners=exchanged)
    return Message("{why}; {otherwise}", why=why, otherwise=otherwise) if otherwise else why
