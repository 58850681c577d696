"""What shall be done to a unit: a programme, read from TOML and validated before anything moves."""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from hashlib import sha256
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import ClassVar, Final, Literal

from pydantic import BaseModel, ConfigDict, Field, PrivateAttr, model_validator

from tumble.drivers.names import GivenName
from tumble.drivers.tables import MOST_SAMPLES
from tumble.messages import Message
from tumble.procedures.acquisition import Acquisition
from tumble.procedures.approach import Approach
from tumble.procedures.composition import Part, compose
from tumble.procedures.errors import InputError, ProgrammeError
from tumble.procedures.layout import Layout
from tumble.procedures.registry import FIRST, find_method, usable_methods
from tumble.procedures.soaking import Soak
from tumble.procedures.steps import Direction, Dwell, Procedure
from tumble.procedures.toml_lines import parse_toml, place_of, read_text
from tumble.procedures.toml_text import read_toml

MOST_DWELLS = 200_000
"""In a run: a week or two of stand time."""
_DIRECTIONS: Final[Mapping[str, Direction]] = {"up": 1, "down": -1, "either": 0}
_STRICT = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


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


def shipped_programmes() -> list[str]:
    """Names of the programmes that come along with all methods, those of the first method at the beginning."""
    return list(_shipped())


def load_programme(name_or_path: str | Path) -> Programme:
    """Read a programme that comes along, by its name, or one from a file: TOML, or a table of settings (CSV).

    Raises
    ------
    ProgrammeError
        Where there is no such programme, or it is not a valid one: file, line, what is wrong and what to do.
    """
    if (entry := _shipped().get(str(name_or_path))) is not None:
        return programme_from_text(entry.read_bytes().decode("utf-8"), entry.name)
    path = Path(name_or_path)
    if not path.is_file():
        names = ", ".join(shipped_programmes())
        raise ProgrammeError(
            Message(
                "{name_or_path}: there is no such file; give a TOML file or one of {names}",
                name_or_path=name_or_path,
                names=names,
            )
        )
    try:
        text = read_text(path)
        return programme_from_text(_listed(text, path) if path.suffix.lower() == ".csv" else text, path.name)
    except InputError as error:
        raise ProgrammeError(str(error)) from error


def _listed(text: str, path: Path) -> str:
    """The programme of a table of settings. Raises `InputError` where no method knows such a one."""
    makers = [part.listed for method in usable_methods() if (part := method.procedure_part).listed]
    try:
        programmes = [programme for make in makers if (programme := make(text, path.stem))]
    except ValueError as error:
        raise InputError(Message("{path}: {error}; correct it", path=path, error=error)) from error
    if not programmes:
        raise InputError(
            Message("{path}: no method measures at settings of these columns; give a TOML file", path=path)
        )
    return programmes[0]


def programme_from_text(text: str, source: str) -> Programme:
    """Read a programme from TOML, for example from a recording; messages call it `source`. Raises `ProgrammeError`."""
    try:
        programme = parse_toml(text, _schema(text, source), source)
    except InputError as error:
        raise ProgrammeError(str(error)) from error
    programme._text = text
    programme._source = source
    return programme


def _schema(text: str, source: str) -> type[Programme]:
    """The schema of a programme's method. Raises `InputError`."""
    name = read_toml(text, source).get("method", FIRST)
    try:
        return find_method(str(name)).procedure_part.programme
    except ValueError as error:
        where = place_of(source, text, ("method",))
        raise InputError(Message("{where}: method: {error}; correct it", where=where, error=error)) from error


def _shipped() -> dict[str, Traversable]:
    """The programmes that come along, by name."""
    programmes: dict[str, Traversable] = {}
    for method in usable_methods():
        entries = method.procedure_part.shipped.iterdir()
        found = {entry.name.removesuffix(".toml"): entry for entry in entries if entry.name.endswith(".toml")}
        programmes |= dict(sorted(found.items()))
    return programmes
