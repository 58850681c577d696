"""The verdict: how a unit stands against the limits of its programme. `judging` reaches it."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Final

from tumble.messages import Message

DECISION_RULE = "simple acceptance"


class Model(StrEnum):
    """Which of the two models a value comes from."""

    DECLARED = "declared"
    AUGMENTED = "augmented"
    """The declared model with the effects that were found."""


class Outcome(StrEnum):
    """What is decided, of one parameter or of all; the first outranks the others."""

    FAIL = "fail"
    NOT_DECIDED = "not_decided"
    PASS = "pass"
    NO_LIMITS = "no_limits"
    """The programme states none."""

    @property
    def words(self) -> Message:
        """The same for a reader."""
        return _WORDS[self]

    @property
    def good(self) -> bool:
        """Whether nothing is left to be done: exit status 0."""
        return self in (Outcome.PASS, Outcome.NO_LIMITS)


_WORDS: Final = {
    Outcome.FAIL: Message("fail"),
    Outcome.NOT_DECIDED: Message("not decided"),
    Outcome.PASS: Message("pass"),
    Outcome.NO_LIMITS: Message("not judged"),
}


@dataclass(frozen=True, kw_only=True)
class Judgement:
    """One parameter against its limits."""

    name: str
    outcome: Outcome
    reason: str
    """Why, in words that go after a colon."""
    remedy: str = ""
    """What would decide, or what to do; empty where there is nothing to say."""

    @property
    def sentence(self) -> str:
        """`ky not decided: it rests on kxy alone; one sweep in face-down would settle it`."""
        fields = {"name": self.name, "outcome": self.outcome.words, "reason": self.reason}
        if not self.remedy:
            return Message("{name} {outcome}: {reason}", **fields)
        return Message("{name} {outcome}: {reason}; {remedy}", **fields, remedy=self.remedy)


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """All limited parameters, and the model that was judged."""

    judged: Model
    parameters: tuple[Judgement, ...]

    @property
    def outcome(self) -> Outcome:
        """The gravest of the parameters' outcomes."""
        found = {judgement.outcome for judgement in self.parameters}
        return next((outcome for outcome in Outcome if outcome in found), Outcome.NO_LIMITS)

    def named(self, outcome: Outcome) -> tuple[str, ...]:
        """The parameters with an outcome."""
        return tuple(judgement.name for judgement in self.parameters if judgement.outcome == outcome)

    def of(self, name: str) -> Judgement | None:
        """What is said of a parameter; None where it has no limits."""
        return next((judgement for judgement in self.parameters if judgement.name == name), None)

    def as_json(self) -> dict[str, Any]:
        """The verdict as the result formats have it."""
        return {
            "outcome": str(self.outcome),
            "judged": str(self.judged),
            "decision_rule": DECISION_RULE,
            "parameters": [
                {"name": each.name, "outcome": str(each.outcome), "reason": each.reason, "remedy": each.remedy}
                for each in self.parameters
            ],
        }


def verdict_from_json(content: Mapping[str, Any]) -> Verdict:
    """Undo `Verdict.as_json`."""
    return Verdict(
        judged=Model(content["judged"]),
        parameters=tuple(Judgement(**{**each, "outcome": Outcome(each["outcome"])}) for each in content["parameters"]),
    )
