"""What a person who reads the head is asked where the voltage contradicts the reading."""

from collections.abc import Sequence

from tumble.drivers.manual.reading import on_the_circle
from tumble.messages import Message
from tumble.procedures.methods.dividing_head.doubt import Doubt, doubt
from tumble.procedures.methods.dividing_head.layout import HEAD
from tumble.procedures.methods.dividing_head.rows import row_of
from tumble.procedures.second_look import Contradiction
from tumble.procedures.steps import Point


def contradiction(point: Point, points: Sequence[Point]) -> Contradiction | None:
    """What contradicts the head's reading at a point, by the points before it; None where nothing does."""
    row = row_of(point)
    against = doubt(row, [row_of(other) for other in points])
    return None if against is None else Contradiction(positioner=HEAD, prompt=_prompt(row.angle_deg, against))


def _prompt(angle_deg: float, against: Doubt) -> str:
    angle = on_the_circle(angle_deg)
    if against.likely_deg is None:
        return Message(
            "The voltage is {off_v:+.6f} V off at {angle}, which no single wrong digit explains. Read again and type "
            "what you read; Enter keeps it.",
            off_v=against.off_v,
            angle=angle,
        )
    return Message(
        "The voltage is {off_v:+.6f} V off at {angle} and would fit {likely}: a wrong {slip}? Read again and type "
        "what you read; Enter keeps it.",
        off_v=against.off_v,
        angle=angle,
        likely=on_the_circle(against.likely_deg),
        slip=against.slip,
    )
