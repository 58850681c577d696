"""The loop closed on a table of any method: what was found, what is withheld, what is left unexplained."""

from dataclasses import dataclass
from typing import ClassVar, Generic, Protocol, TypeVar

from tumble.calibrations.core.parameter import ModelFit
from tumble.calibrations.core.rows import Rows
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.explained import Explained
from tumble.calibrations.tracing.findings import (
    EffectFound,
    Unexplained,
    Withheld,
    effects_found,
    unexplained,
    withheld,
)
from tumble.calibrations.tracing.quantified import Quantified
from tumble.calibrations.tracing.table import Table


class DeclaredFit(Protocol):
    """The declared model fitted to a table."""

    @property
    def observations(self) -> Rows:
        """Rows in use; those that are not stand in its `set_aside`."""
        ...

    @property
    def doubts(self) -> tuple[str, ...]:
        """Questions about the table; where there are any, nothing is stated."""
        ...

    @property
    def model(self) -> ModelFit:
        """Parameters and residual."""
        ...


_D = TypeVar("_D", bound=DeclaredFit)
_T = TypeVar("_T", bound=Table)
_F = TypeVar("_F", bound=Quantified)


@dataclass(frozen=True, kw_only=True)
class ClosedLoop(Generic[_D, _T, _F]):
    """The loop closed on a table; a method derives from it what it has beside."""

    unit: ClassVar[str]
    """Of the output, as keys end in it."""

    declared_fit: _D
    explained: Explained[_T, _F]
    augmented: ModelFit
    experiments: tuple[Experiment, ...] = ()
    """What to measure next, where that was asked."""

    @property
    def doubts(self) -> tuple[str, ...]:
        """Questions about the table; where there are any, nothing is stated."""
        return self.declared_fit.doubts

    @property
    def declared(self) -> ModelFit:
        """The declared model."""
        return self.declared_fit.model

    @property
    def best(self) -> _F:
        """The fit with what was found."""
        return self.explained.best

    @property
    def held_out_rms(self) -> float | None:
        """Error of settings that are held out, with what was found, in the unit of the output."""
        return self.augmented.held_out_rms

    @property
    def effects(self) -> tuple[EffectFound, ...]:
        """What was found, in the order of the evidence; nothing of a table in doubt."""
        if self.doubts:
            return ()
        found = effects_found(self.explained.table, self.explained.judged, self.best, self.explained.close)
        return tuple(sorted(found, key=lambda effect: effect.p_value))

    @property
    def withheld(self) -> tuple[Withheld, ...]:
        """What would fit the rows and is not stated."""
        return () if self.doubts else withheld(self.explained.table, self.explained.judged)

    @property
    def unexplained(self) -> Unexplained | None:
        """The largest structure that no effect of the catalogue explains; None where there is none."""
        return None if self.doubts else unexplained(self.explained.trace, self.explained.alike)
