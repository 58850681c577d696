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


def qualified(why: Message, needed: Sequence[str], others: Sequence[str], runs: int, likely: bool) -> Message:
    """The same with its conditions: which explanation must be true, what must be run with it, how often, how sure."""
    if needed:
        why = Message("{why}, if {names} is the true one", why=why, names=series(needed))
    if others:
        why = Message("{why}; only together with {programmes}", why=why, programmes=series(others))
    if runs > 1:
        why = Message.counted("{why}; run it {count} time", "{why}; run it {count} times", why=why, count=runs)
    if likely:
        why = Message("{why}; so much is likely, but not sure", why=why)
    return why


def no_programme(name: str, rivals: Sequence[str], separation: float, remedy: str) -> Message:
    """That no experiment separates explanations, by how much they differ at most, and what would."""
    why = Message(
        "no programme that comes along tells {name} from {rivals}: they differ by {difference} at most",
        name=name,
        rivals=series(rivals, "or"),
        difference=deviations(separation),
    )
    return Message("{why}; {remedy}", why=why, remedy=remedy) if remedy else why


def remedied(owners: Collection[str], probes: Sequence[Probe], runs: int, otherwise: str) -> str:
    """What would tell explanations apart where no programme does; empty where nothing is known to.

    Parameters
    ----------
    owners
        To what the explanations belong.
    probes, runs
        What would have to be run so often; `runs` is 0 where no number would do.
    otherwise
        What the method knows of.
    """
    ways: list[str] = []
    if len(owners) > 1:
        exchanged = series(sorted(_OWNERS[owner] for owner in owners))
        ways.append(Message("as they belong to {owners}, exchange one of these", owners=exchanged))
    if runs:
        names = series(list(dict.fromkeys(probe.programme for probe in probes)))
        ways.append(
            Message.counted(
                "run {programmes} some {count} time",
                "run {programmes} some {count} times",
                programmes=names,
                count=runs,
            )
        )
    if otherwise:
        ways.append(otherwise)
    return Message.joined("; ", ways) if ways else ""
