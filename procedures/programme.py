"""What shall be done to a unit: a programme, read from TOML and validated before anything moves."""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from hashlib import sha256
from typing import ClassVar, Final, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, PrivateAttr, model_validator

from tumble.drivers.names import GivenName
from tumble.drivers.tables import MOST_SAMPLES
from tumble.messages import Message
from tumble.procedures.acquisition import Acquisition
from tumble.procedures.approach import Approach
from tumble.procedures.composition import Part, compose
from tumble.procedures.layout import Layout
from tumble.procedures.soaking import Soak
from tumble.procedures.steps import Direction, Dwell, Procedure
from tumble.procedures.toml_lines import parse_toml, place_of

MOST_DWELLS = 200_000
"""In a run: a week or two of stand time."""
_DIRECTIONS: Final[Mapping[str, Direction]] = {"up": 1, "down": -1, "either": 0}
_STRICT = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


def check_ends(dwells: int) -> None:
    """Refuse a programme that would not end within weeks. Raises `ValueError`."""
    if dwells > MOST_DWELLS:
        raise ValueError(
            Message(
                "{dwells:,} dwells or more, where {most:,} are the most: ask for fewer",
                dwells=dwells,
                most=MOST_DWELLS,
            )
        )


class Limit(BaseModel):
    """The interval in which a parameter must lie, in the parameter's unit."""

    model_config = _STRICT

    min: float
    max: float

    @model_validator(mode="after")
    def _in_order(self) -> "Limit":
        if not self.min < self.max:
            raise ValueError(Message("min = {min:g} is not below max = {max:g}", min=self.min, max=self.max))
        return self


class SoakTable(BaseModel):
    """When a unit has taken on the temperature of a chamber; see `tumble.procedures.soaking.Soak`."""

    model_config = _STRICT

    window_s: float = Field(default=600.0, gt=0.0, le=86_400.0)
    tolerance_k: float = Field(default=0.5, gt=0.0, alias="tolerance_K")
    rate_k_per_h: float = Field(default=1.0, gt=0.0, alias="rate_K_per_h")
    slope_v_per_h: float | None = Field(default=None, gt=0.0, alias="slope_V_per_h")
    look_s: float = Field(default=30.0, gt=0.0, le=3600.0)
    timeout_s: float = Field(default=14_400.0, gt=0.0, le=604_800.0)

    @model_validator(mode="after")
    def _enough_looks(self) -> "SoakTable":
        if self.window_s < 4.0 * self.look_s:
            raise ValueError(Message("window_s is less than four times look_s: make it longer"))
        return self


class Programme(BaseModel, ABC):
    """Procedures, repeated, and how each of their dwells is taken: what the programmes of all methods have in common.

    A method derives its schema from this one, gives its `method` as a literal, and adds its procedures. What the
    programme does not say of samples comes from the stand; `samples` goes before `dwell_s`.
    """

    model_config = _STRICT

    layout: ClassVar[Layout]
    """The columns of the points that it leads to."""

    method: str
    name: GivenName
    unit_type: GivenName | None = None
    """Type of the units that it is for: with it are kept the effects that a laboratory adopts."""
    realisations: int = Field(default=1, ge=1, le=10_000)
    dwell_s: float | None = Field(default=None, gt=0.0, le=86_400.0)
    """Duration of a dwell; samples = duration times the DAQ's rate, rounded."""
    samples: int | None = Field(default=None, ge=2, le=MOST_SAMPLES)
    """Samples in a dwell."""
    settle_s: float = Field(default=0.2, ge=0.0)
    settle_samples: int | None = Field(default=None, ge=2)
    """Samples in a block; without it a tenth of the dwell's, but at least 5."""
    settle_tolerance: float = Field(default=3.0, gt=0.0)
    settle_tolerance_v: float | None = Field(default=None, gt=0.0)
    settle_timeout_s: float = Field(default=10.0, gt=0.0)
    position_tolerance_deg: float = Field(default=0.01, gt=0.0)
    approach: Literal["up", "down", "either"] = "either"
    """In which direction the head arrives at every angle; `either` leaves it to where it comes from."""
    overshoot_deg: float = Field(default=2.0, gt=0.0, le=90.0)
    """How far beyond an angle the head goes to come back to it in that direction."""
    soak: SoakTable = SoakTable()
    """When a unit has taken on a temperature, where the stand has a chamber."""
    limits: Mapping[str, Limit] = Field(default_factory=dict)

    _text: str = PrivateAttr("")
    _source: str = PrivateAttr("")

    @classmethod
    def from_text(cls, text: str, source: str) -> Self:
        """Read a programme of this method from TOML; messages call it `source`. Raises `InputError`."""
        programme = parse_toml(text, cls, source)
        programme._text = text
        programme._source = source
        return programme

    @property
    def text(self) -> str:
        """The programme as it was read, TOML."""
        return self._text

    @property
    def sha256(self) -> str:
        """SHA-256 of the text in UTF-8, hexadecimal."""
        return sha256(self._text.encode()).hexdigest()

    @property
    @abstractmethod
    def parts(self) -> Sequence[Part]:
        """The procedures, in order."""

    @abstractmethod
    def nominal(self, dwell: Dwell) -> Mapping[str, float]:
        """What a nominal unit gives in a dwell, by channel: for planning, where a procedure goes by what it sees."""

    def procedure(self) -> Procedure:
        """All procedures, in order, as often as there are realisations: what an engine runs."""
        return compose(self.parts, self.realisations, self.layout.ask)

    def acquisition(self, *, samples: int, rate_hz: float) -> Acquisition:
        """How a dwell is taken at a stand whose DAQ samples at `rate_hz`, and takes `samples` unless told otherwise."""
        if self.samples is not None:
            samples = self.samples
        elif self.dwell_s is not None:
            samples = max(2, round(self.dwell_s * rate_hz))
        return Acquisition(
            samples=samples,
            rate_hz=rate_hz,
            position_tolerance_deg=self.position_tolerance_deg,
            approach=Approach(direction=_DIRECTIONS[self.approach], overshoot_deg=self.overshoot_deg),
            settle_s=self.settle_s,
            settle_samples=self.settle_samples or max(5, samples // 10),
            settle_tolerance=self.settle_tolerance,
            settle_tolerance_v=self.settle_tolerance_v,
            settle_timeout_s=self.settle_timeout_s,
            soak=Soak(**self.soak.model_dump()),
        )

    def where(self, procedure: int) -> str:
        """File and line of a procedure, counted from 0, for a message."""
        return place_of(self._source, self._text, ("procedure", procedure))
