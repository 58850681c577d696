"""What is said of a head table, the same on the terminal and in the report."""

from collections.abc import Sequence

from tumble.calibrations.core.quantities import format_concise, format_number
from tumble.calibrations.core.sentences import equals, series
from tumble.calibrations.methods.head_reference.adequacy import AngleError, Side
from tumble.calibrations.methods.head_reference.changes import Change, Comparison
from tumble.calibrations.methods.head_reference.loop import ReferenceLoop
from tumble.calibrations.methods.head_reference.map_difference import Difference
from tumble.messages import Message

SETTINGS_HEADINGS = (
    Message("Angle"),
    Message("Forward"),
    Message("Backward"),
    Message("Forward minus backward"),
    Message("Visits"),
)
PARTS_HEADINGS = (
    Message("Angles"),
    Message("Direction"),
    Message("Difference, mean"),
    Message("Lowest"),
    Message("Highest"),
    Message("Beyond the constant part"),
)
CHANGES_HEADINGS = (
    Message("The difference shows"),
    Message("Or"),
    Message("Size of the difference"),
    Message("First table alone"),
    Message("Second table alone"),
)
_PLACES = 9
"""Decimals of a degree that a difference of two tables can have; what is below is rounding of the computer."""
_SIDES = {1: "+", -1: "-", 0: Message("not known")}


def headline(loop: ReferenceLoop) -> str:
    """To what the table was traced; where nothing was looked for, that and why, never that there is nothing."""
    if loop.question:
        return Message("nothing is stated before that is answered.")
    if loop.not_traced:
        return Message("nothing was looked for: {reason}.", reason=loop.not_traced)
    names = list(dict.fromkeys(effect.name for effect in loop.effects))
    if names:
        return Message("what the reference says beyond the head was traced to {names}.", names=series(names))
    if loop.unexplained:
        return Message("no effect of the catalogue explains what the reference says beyond the head.")
    return Message("what the reference says beyond the head shows no effect.")


def setting_rows(errors: Sequence[AngleError]) -> list[tuple[str, ...]]:
    """Cells of the table of settings, one row for each angle, under `SETTINGS_HEADINGS`."""
    return [
        (
            f"{each.angle_deg:.10g}°",
            _side(each.forward or each.unknown),
            _side(each.backward),
            _number(each.reversal_deg, each.reversal_uncertainty_deg),
            " + ".join(str(side.visits) for side in (each.forward, each.backward, each.unknown) if side),
        )
        for each in errors
    ]


def most_different(errors: Sequence[AngleError], most: int) -> tuple[list[AngleError], int]:
    """So many angles at most, those with the largest reversal error, in the order of the angle; how many are left."""
    ranked = sorted(errors, key=lambda each: -abs(each.reversal_deg or 0.0))
    return sorted(ranked[:most], key=lambda each: each.angle_deg), max(len(errors) - most, 0)


def sentences(comparison: Comparison, first: str, second: str) -> list[str]:
    """What two tables say of each other, in the order in which it is asked."""
    difference = comparison.difference
    if difference is None:
        return [
            Message(
                "{first} and {second} cannot be compared: they share fewer than three angles in one direction, or "
                "nothing is stated of one of them.",
                first=first,
                second=second,
            )
        ]
    lowest, highest = difference.difference_deg.min(), difference.difference_deg.max()
    freedom = f"{len(difference) - 1}, {difference.degrees_of_freedom}"
    test = f"F({freedom}) = {difference.f:.3g}, p {equals(difference.p_value)}"
    return [
        Message.counted(
            "{second} minus {first}, at {count} angle that both visited in the same direction: the errors differ by "
            "{lowest_deg:.3g}° to {highest_deg:.3g}°. Uncertainties are from {basis}.",
            "{second} minus {first}, at {count} angles that both visited in the same direction: the errors differ "
            "by {lowest_deg:.3g}° to {highest_deg:.3g}°. Uncertainties are from {basis}.",
            first=first,
            second=second,
            count=len(difference),
            lowest_deg=lowest,
            highest_deg=highest,
            basis=difference.basis,
        ),
        _verdict(comparison, difference, test),
        *_slopes(comparison, first, second),
        *comparison.limits,
    ]


def _verdict(comparison: Comparison, difference: Difference, test: str) -> Message:
    offset = Message(
        "{offset_deg:.3g}° (standard uncertainty {uncertainty_deg:.2g}°)",
        offset_deg=difference.constant_deg,
        uncertainty_deg=difference.constant_uncertainty_deg,
    )
    if comparison.changed:
        return Message(
            "The difference is no constant ({test}): the error of the head changed. Its mean, {offset}, could be the "
            "set-up's or the head's.",
            test=test,
            offset=offset,
        )
    return Message(
        "Nothing changed beyond its uncertainty but a constant ({test}): the set-up moved by {offset}, which is no "
        "change of the head.",
        test=test,
        offset=offset,
    )


def _slopes(comparison: Comparison, first: str, second: str) -> list[str]:
    """Slope of the error of each alone, where a slope is not the beginning of a wave that was seen whole."""
    if comparison.slopes is None or comparison.whole_turn:
        return []
    each = [
        Message("{slope} for {table}", slope=format_concise(value, uncertainty, ""), table=name)
        for (value, uncertainty), name in zip(comparison.slopes, (first, second), strict=True)
    ]
    return [
        Message("By itself the error rises with the angle by {slopes}, in degrees per degree.", slopes=series(each))
    ]


def part_rows(comparison: Comparison) -> list[tuple[str, ...]]:
    """Cells of the table of the difference by parts of the arc, under `PARTS_HEADINGS`."""
    return [
        (
            f"{part.from_deg:.4g}°" if part.from_deg == part.to_deg else f"{part.from_deg:.4g}° to {part.to_deg:.4g}°",
            _SIDES[part.direction],
            format_concise(part.mean_deg, part.uncertainty_deg, "deg"),
            format_number(round(part.lowest_deg, _PLACES), "deg"),
            format_number(round(part.highest_deg, _PLACES), "deg"),
            Message("yes") if part.differs else Message("no"),
        )
        for part in comparison.parts
    ]


def change_rows(comparison: Comparison) -> list[tuple[str, ...]]:
    """Cells of the table of what the difference shows, under `CHANGES_HEADINGS`."""
    return [
        (
            _name(change),
            series(change.also_possible, "or") if change.also_possible else "",
            format_concise(change.difference, change.standard_uncertainty, change.unit),
            *(_alone(size, change) for size in (change.before, change.after)),
        )
        for change in comparison.changes
    ]


def _name(change: Change) -> str:
    if change.order is None:
        return change.name
    return Message("{name}, {order} per turn", name=change.name, order=change.order)


def _alone(size: float, change: Change) -> str:
    """Size in one table alone; not where another effect may have taken its place there."""
    if change.also_possible:
        return Message("not distinguishable")
    return format_number(size, change.unit) if size else Message("none")


def _side(side: Side | None) -> str:
    return "" if side is None else _number(side.error_deg, side.standard_uncertainty_deg)


def _number(value: float | None, uncertainty: float | None) -> str:
    return "" if value is None or uncertainty is None else format_concise(value, uncertainty, "deg")
