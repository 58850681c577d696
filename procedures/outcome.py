"""How a run ended, in a form that a caller can act on."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

from tumble.drivers.errors import DeviceError
from tumble.messages import Message
from tumble.procedures.errors import StopRequestedError, StorageError, UnansweredError
from tumble.procedures.events import FinishReason, RunFinished
from tumble.procedures.steps import Point


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """How a run ended."""

    reason: FinishReason
    message: str
    points: tuple[Point, ...]
    """All points of the run, those before it was resumed included."""
    at_standstill: bool
    """Whether the rest of all positioners was read back."""
    error: BaseException | None = None
    """What ended the run, where it was not completed."""

    @property
    def finished(self) -> RunFinished:
        """The event that says so."""
        return RunFinished(reason=self.reason, message=self.message, at_standstill=self.at_standstill)


_REASONS: Final = {
    StopRequestedError: FinishReason.STOPPED,
    KeyboardInterrupt: FinishReason.STOPPED,
    UnansweredError: FinishReason.UNANSWERED,
    DeviceError: FinishReason.DEVICE_FAULT,
    StorageError: FinishReason.STORAGE,
}


def outcome_of(error: BaseException | None, points: Iterable[Point], at_standstill: bool, moving: str) -> Outcome:
    """The outcome of a run that `error` has ended, or that came to its end; `moving` is what sentences call what moves.

    Without a standstill no run is completed: where nothing else has gone wrong, that is the device fault.
    """
    restless = DeviceError(
        moving, Message("its standstill could not be read back"), Message("look at it before you touch it")
    )
    message = message_of(error)
    if not at_standstill:
        message = Message("{message}; {restless}", message=message, restless=restless) if error else str(restless)
        error = error or restless
    return Outcome(
        reason=_reason_of(error), message=message, points=tuple(points), at_standstill=at_standstill, error=error
    )


def message_of(error: BaseException | None) -> str:
    """Why a run ended that `error` has ended, as a sentence for the operator."""
    if error is None:
        return Message("the programme was carried out")
    if isinstance(error, KeyboardInterrupt):
        return Message("the operator interrupted the program")
    if _reason_of(error) is FinishReason.INTERNAL:
        return Message(
            "a fault of the program: {kind}: {error}; report it, then resume the run",
            kind=type(error).__name__,
            error=error,
        )
    return str(error)


def _reason_of(error: BaseException | None) -> FinishReason:
    if error is None:
        return FinishReason.COMPLETED
    return next((reason for kind, reason in _REASONS.items() if isinstance(error, kind)), FinishReason.INTERNAL)
