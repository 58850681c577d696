"""All positioners of a stand: they set out together, and come to rest together."""

from collections.abc import Callable, Generator, Mapping
from functools import partial
from typing import TypeAlias

from tumble.calibrations.core.sentences import series
from tumble.drivers.errors import DeviceError
from tumble.drivers.protocols import PositionerStatus, Stand
from tumble.messages import Message
from tumble.procedures.acquisition import Acquisition
from tumble.procedures.approach import Place
from tumble.procedures.errors import ProcedureError
from tumble.procedures.journeys import Journey, together
from tumble.procedures.losses import Losses
from tumble.procedures.motion import Motion, standstill
from tumble.procedures.steps import Direction

Look: TypeAlias = Callable[[str, PositionerStatus], None]
"""Is shown where a positioner is, by its name."""


def look_away(_name: str, _status: PositionerStatus) -> None:
    """Look at nothing."""


class Axes:
    """Moves of the positioners of a stand, by name.

    `look` is shown where each of them is whenever that is read on its way.
    """

    def __init__(
        self,
        stand: Stand,
        acquisition: Acquisition,
        losses: Losses,
        look: Look = look_away,
    ) -> None:
        self._clock = stand.attentive_clock
        self.motions = {
            name: Motion(
                positioner,
                self._clock,
                acquisition.position_tolerance_deg,
                acquisition.approach,
                partial(look, name),
                title=stand.title(name),
            )
            for name, positioner in stand.positioners.items()
        }
        """Of every single one."""
        self._losses = losses

    @property
    def places(self) -> dict[str, Place]:
        """Where the last journey of each positioner ended; none of one that has made none."""
        return {name: motion.place for name, motion in self.motions.items() if motion.place is not None}

    def directions(self, names: Mapping[str, object]) -> dict[str, Direction]:
        """Sign of the last move of the named positioners; 0 before the first."""
        return {name: self.motions[name].direction for name in names}

    def travel(self, targets_deg: Mapping[str, float], checkpoint: Callable[[], bool]) -> dict[str, float]:
        """Go to all targets at once; returns where the positioners say they are, in degrees. See `Motion.travel`."""
        journeys = {name: self._motion(name).journey(angle_deg) for name, angle_deg in targets_deg.items()}
        return self._made(journeys, checkpoint)

    def return_to(self, places: Mapping[str, Place], checkpoint: Callable[[], bool]) -> dict[str, float]:
        """Go back to places and arrive there as then; returns as `travel`."""
        return self._made({name: self._motion(name).way_back(place) for name, place in places.items()}, checkpoint)

    def unwind(self, checkpoint: Callable[[], bool]) -> None:
        """Turn every positioner back for the sake of its cable, one after the other. See `Motion.unwind`."""
        for name, motion in self.motions.items():
            with self._losses.using(name):
                motion.unwind(checkpoint)

    def home(self, checkpoint: Callable[[], bool]) -> None:
        """Have every positioner find its reference, one after the other. See `Motion.home`."""
        for name, motion in self.motions.items():
            with self._losses.using(name):
                motion.home(checkpoint)

    def check_rest(self, positions_deg: Mapping[str, float]) -> None:
        """Make sure that the positioners still stand where they were sent. Raises `DeviceError`."""
        for name, angle_deg in positions_deg.items():
            with self._losses.using(name):
                self.motions[name].check_rest(angle_deg)

    def brake(self) -> None:
        """Tell every positioner to stop, also where another cannot be told. Raises the first `DeviceError` of these.

        None that turns waits behind one that rests, or that was silent.
        """
        failures: list[Exception] = []
        for name, motion in sorted(self.motions.items(), key=self._urgency):
            try:
                with self._losses.using(name):
                    motion.brake()
            except Exception as error:  # the others still move
                failures.append(error)
        if failures:
            raise failures[0]

    def halt(self) -> None:
        """Tell all to stop and read their rest back. Raises `DeviceError` where one does not come to rest."""
        self.brake()
        if not self.standstill():
            titles = series([motion.title for motion in self.motions.values()], "or")
            raise DeviceError(titles, Message("cannot be brought to rest"), Message("switch it off and look at it"))

    def standstill(self) -> bool:
        """Read the rest of all back, see `Motion.standstill`; a stand without positioners is at rest."""
        return standstill(list(self.motions.values()), self._clock)

    def _urgency(self, named: tuple[str, Motion]) -> tuple[bool, bool]:
        name, motion = named
        return not motion.under_way, name in self._losses.unheard

    def _motion(self, name: str) -> Motion:
        if name not in self.motions:
            there = ", ".join(self.motions) or "none"
            raise ProcedureError(f"a dwell was asked for at a position of {name}; the positioners are {there}")
        return self.motions[name]

    def _made(self, journeys: Mapping[str, Journey], checkpoint: Callable[[], bool]) -> dict[str, float]:
        noting = [self._noting(name, journey) for name, journey in journeys.items()]
        statuses = together(noting, self._clock, checkpoint)
        return {name: status.angle_deg for name, status in zip(journeys, statuses, strict=True)}

    def _noting(self, name: str, journey: Journey) -> Generator[None, bool | None, PositionerStatus]:
        """The journey, noting whose link it was that was lost."""
        with self._losses.using(name):
            return (yield from journey)
