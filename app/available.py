"""Which experiments a stand can run, and what each of them takes; a method asks the stand for its own."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from tumble.calibrations.tracing.probe import Probe
from tumble.procedures.programme import Programme
from tumble.procedures.steps import Ask


@dataclass(frozen=True, kw_only=True)
class Offer:
    """An experiment as a stand would run it."""

    probe: Probe
    """What it would add to a table."""
    programme: Programme
    needs: Mapping[str, str] = field(default_factory=dict)
    """What a person must set for it, by condition: `mount`, say, is `face-down`."""
    preparation: Ask | None = None
    """What a person must do before it begins; None for nothing. It is one of `needs`."""
    wait_s: float = 0.0
    """Time that must pass before it begins, where nobody has to do anything."""


@dataclass(frozen=True, kw_only=True)
class Available:
    """Experiments that can be run, as long as this stand takes for them, and those that cannot."""

    offers: tuple[Offer, ...] = ()
    refused: Mapping[str, tuple[Offer, str]] = field(default_factory=dict)
    """Each with the reason, by the name of its programme."""

    def without(self, gone: Callable[[Offer], bool], reason: str) -> "Available":
        """What is left once some of it cannot be run any more."""
        refused = {offer.programme.name: (offer, reason) for offer in self.offers if gone(offer)}
        left = tuple(offer for offer in self.offers if not gone(offer))
        return Available(offers=left, refused={**self.refused, **refused})

    @property
    def probes(self) -> tuple[Probe, ...]:
        """What the experiments that can be run would add."""
        return tuple(offer.probe for offer in self.offers)

    def offer(self, programme: str) -> Offer:
        """The experiment of a programme."""
        return next(offer for offer in self.offers if offer.programme.name == programme)
