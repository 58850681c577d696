"""Does what was found agree with the repeats: lack of fit of a head table, and how the error differs by setting."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from tumble.calibrations.core.adequacy import LackOfFit, lack_of_fit
from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.sentences import equals
from tumble.calibrations.methods.head_reference.scene import HeadScene
from tumble.calibrations.methods.head_reference.settings import Settings, angle_numbers
from tumble.calibrations.tracing.findings import Unexplained
from tumble.messages import Message

BEYOND_REPEATS_P = 1e-3
"""Settings differ where chance makes them differ as much more seldom than this."""


@dataclass(frozen=True, kw_only=True)
class Agreement:
    """A model of the error of a head against the scatter of repeats."""

    test: LackOfFit
    pure_degrees_of_freedom: int
    f: float | None
    """Mean square of the lack of fit over that of the repeats; None where they scatter by nothing at all."""

    @property
    def contradicted(self) -> bool:
        """Whether settings differ from the model by more than their repeats allow."""
        return self.test.p_value is not None and self.test.p_value < BEYOND_REPEATS_P

    @property
    def words(self) -> str:
        """The test as it is printed."""
        if self.f is None or self.test.p_value is None:
            return ""
        freedom = f"{self.test.degrees_of_freedom}, {self.pure_degrees_of_freedom}"
        return f"F({freedom}) = {self.f:.3g}, p {equals(self.test.p_value)}"


def agreement(residual_deg: FloatArray, fitted: int, settings: Settings) -> Agreement | None:
    """Test a residual, shape (rows,), of a model with so many parameters; None where nothing was visited twice."""
    if not settings.repeated:
        return None
    error = settings.pure_error(residual_deg)
    test = lack_of_fit(float(residual_deg @ residual_deg), len(residual_deg), fitted, error)
    f = test.variance / error.variance if error.variance > 0 and test.degrees_of_freedom else None
    return Agreement(test=test, pure_degrees_of_freedom=error.degrees_of_freedom, f=f)


@dataclass(frozen=True, kw_only=True)
class Side:
    """One angle, reached from one side."""

    error_deg: float
    """Mean of reference minus head."""
    standard_uncertainty_deg: float
    """From the pooled scatter of repeats."""
    visits: int


@dataclass(frozen=True, kw_only=True)
class AngleError:
    """The error of a head at one angle, as its repeats say it."""

    angle_deg: float
    forward: Side | None
    backward: Side | None
    unknown: Side | None
    """Reached from a side that the table does not say."""

    @property
    def reversal_deg(self) -> float | None:
        """Forward minus backward; None where one of them is missing."""
        if self.forward is None or self.backward is None:
            return None
        return self.forward.error_deg - self.backward.error_deg

    @property
    def reversal_uncertainty_deg(self) -> float | None:
        """Standard uncertainty of the reversal error."""
        if self.forward is None or self.backward is None:
            return None
        return float(np.hypot(self.forward.standard_uncertainty_deg, self.backward.standard_uncertainty_deg))


def errors_by_setting(scene: HeadScene, error_deg: FloatArray, settings: Settings) -> tuple[AngleError, ...]:
    """Error of each angle by the side from which it was reached, angles ascending; none where nothing was repeated."""
    if not settings.repeated:
        return ()
    scatter_deg = settings.pure_error(error_deg).standard_deviation
    number = angle_numbers(scene.angle_deg)

    def side(at: int, direction: int) -> Side | None:
        chosen = (number == at) & (scene.direction == direction)
        visits = int(np.count_nonzero(chosen))
        if not visits:
            return None
        mean_deg = float(error_deg[chosen].mean())
        return Side(error_deg=mean_deg, standard_uncertainty_deg=scatter_deg / float(np.sqrt(visits)), visits=visits)

    return tuple(
        AngleError(
            angle_deg=float(scene.angle_deg[number == at].mean()),
            forward=side(at, 1),
            backward=side(at, -1),
            unknown=side(at, 0),
        )
        for at in range(int(number.max(initial=-1)) + 1)
    )


@dataclass(frozen=True, kw_only=True)
class Reversal:
    """Whether forward and backward differ by the same everywhere."""

    f: float
    degrees_of_freedom: tuple[int, int]
    p_value: float

    @property
    def differs(self) -> bool:
        """Whether the reversal error is another one at another angle."""
        return self.p_value < BEYOND_REPEATS_P


def reversal(errors: tuple[AngleError, ...], pure_degrees_of_freedom: int) -> Reversal | None:
    """Test whether the reversal error is the same at every angle; None where fewer than two angles show one."""
    from scipy.special import fdtrc  # takes a tenth of a second, in which a window is half up

    known = [(each.reversal_deg, each.reversal_uncertainty_deg) for each in errors if each.reversal_uncertainty_deg]
    if len(known) < 2 or not pure_degrees_of_freedom:
        return None
    values, uncertainty = np.array(known, dtype=np.float64).T
    weights = 1.0 / uncertainty**2
    squares = float(np.sum(weights * (values - np.average(values, weights=weights)) ** 2))
    freedom = len(values) - 1
    f = squares / freedom
    return Reversal(
        f=f,
        degrees_of_freedom=(freedom, pure_degrees_of_freedom),
        p_value=float(fdtrc(freedom, pure_degrees_of_freedom, f)),
    )


def by_setting(
    after: Agreement | None, errors: tuple[AngleError, ...], changing: Reversal | None
) -> Iterator[Unexplained]:
    """What differs from setting to setting beyond the repeats although nothing with a name explains it."""
    if after is None or not after.contradicted:
        return
    description = Message(
        "the error differs from setting to setting by more than its repeats allow ({test})", test=after.words
    )
    if changing is not None and changing.differs:
        values = [each.reversal_deg for each in errors if each.reversal_deg is not None]
        description = Message(
            "{description}; its reversal error too, from {lowest_deg:.3g}° to {highest_deg:.3g}°",
            description=description,
            lowest_deg=min(values),
            highest_deg=max(values),
        )
    yield Unexplained(depends_on="angle", description=description)
