"""Where a chamber keeps what: registers and bits of Modbus, as its manual lists them."""

from typing import Final, Literal, Self, TypeAlias

from pydantic import BaseModel, ConfigDict, Field, model_validator

from tumble.messages import Message

Kind: TypeAlias = Literal["int16", "uint16", "int32", "uint32", "float32"]
_HIGHEST: Final = 65_535
_STRICT = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class Quantity(BaseModel):
    """A number: `value = scale * (what stands in the registers) + offset`. Addresses count from 0."""

    model_config = _STRICT

    input: int | None = Field(default=None, ge=0, le=_HIGHEST)
    """First input register; or"""
    holding: int | None = Field(default=None, ge=0, le=_HIGHEST)
    """first holding register."""
    kind: Kind = "int16"
    word_order: Literal["big", "little"] = "big"
    """Which half of a number in two registers comes first."""
    scale: float = 0.1
    offset: float = 0.0

    @model_validator(mode="after")
    def _one_place(self) -> Self:
        if (self.input is None) == (self.holding is None):
            raise ValueError(Message("give input or holding, the number of the first register, and not both"))
        if self.scale == 0.0:
            raise ValueError(Message("scale is 0: give the value of one count"))
        return self

    @property
    def address(self) -> int:
        """Number of the first register."""
        return self.input if self.holding is None else self.holding  # type: ignore[return-value]  # one is given


class Bit(BaseModel):
    """A bit: `when` says what it is while that holds of which it tells."""

    model_config = _STRICT

    coil: int | None = Field(default=None, ge=0, le=_HIGHEST)
    """Coil; or"""
    discrete: int | None = Field(default=None, ge=0, le=_HIGHEST)
    """discrete input."""
    when: bool = True

    @model_validator(mode="after")
    def _one_place(self) -> Self:
        if (self.coil is None) == (self.discrete is None):
            raise ValueError(Message("give coil or discrete, the number of the bit, and not both"))
        return self

    @property
    def address(self) -> int:
        """Its number."""
        return self.discrete if self.coil is None else self.coil  # type: ignore[return-value]  # one is given


class Registers(BaseModel):
    """What a chamber has; all but the first two may be missing."""

    model_config = _STRICT

    actual: Quantity
    """Temperature of the air, °C."""
    setpoint: Quantity
    """Set point, °C; a holding register."""
    run: Bit | None = None
    """Makes it run; a coil. Without it, it runs by itself."""
    door: Bit | None = None
    """Tells that the door is open."""
    door_lock: Bit | None = None
    """Keeps the door shut; a coil."""
    alarm: Bit | None = None
    """Tells of a fault of its own."""

    @model_validator(mode="after")
    def _can_be_written(self) -> Self:
        if self.setpoint.holding is None:
            raise ValueError(Message("setpoint: only a holding register can be written; give holding"))
        for name in ("run", "door_lock"):
            bit: Bit | None = getattr(self, name)
            if bit is not None and bit.coil is None:
                raise ValueError(Message("{name}: only a coil can be written; give coil", name=name))
        return self
