"""With what the runs of an effect say that it is to be kept."""

from collections.abc import Sequence

from tumble.app.measurement import Measurement
from tumble.app.stand_records import identity_of
from tumble.calibrations.adopted.effect import KeptWith, OfStand, UnitType
from tumble.messages import Message
from tumble.procedures.errors import InputError


def kept_with(measurements: Sequence[Measurement], unit_type: str, *, of_stand: bool) -> KeptWith:
    """The unit type that is named, or else that of the programmes; with `of_stand`, the stand of the runs.

    Raises
    ------
    InputError
        Both were asked for, or the runs are not all of one type, or one stand.
    """
    if of_stand and unit_type:
        raise InputError(Message("--unit-type and --of-stand exclude each other; give one of them"))
    if of_stand:
        return _stand(measurements)
    if unit_type:
        return UnitType(name=unit_type)
    types = {programme.unit_type if (programme := each.programme) else None for each in measurements}
    (only,) = types if len(types) == 1 else (None,)
    if only is None:
        raise InputError(
            Message("the programmes of the runs do not all state one unit_type; give --unit-type or --of-stand")
        )
    return UnitType(name=only)


def _stand(measurements: Sequence[Measurement]) -> OfStand:
    identities = {identity_of(each) for each in measurements}
    (only,) = identities if len(identities) == 1 else (None,)
    if only is None:
        raise InputError(
            Message("the runs are not all of one stand with one head and one DAQ, or do not say so; give --stand")
        )
    return OfStand(identity=only)
