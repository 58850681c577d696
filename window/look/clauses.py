"""Clauses of the engine and of the drivers that the window can say in another language; braces stand for anything."""

from typing import Final

from tumble.messages import translatable

CLAUSES: Final[tuple[str, ...]] = (
    # operator and eyepiece
    translatable("Set the head to {}; Enter when it reads so, or type the reading"),
    translatable(
        "You read {}, the setting was {}: type it again to keep it, or set the head right and press Enter",
    ),
    translatable(
        "The voltage is {} V off at {} and would fit {}: a wrong {}? Read again and type what you read; Enter keeps it",
    ),
    translatable(
        "The voltage is {} V off at {}, which no single wrong digit explains. Read again and type what you read; "
        "Enter keeps it",
    ),
    translatable("{} is no angle; type degrees, minutes and seconds, such as 12 34 56, or 12.5"),
    translatable("{} has a fraction before its last number; type it without"),
    translatable("{} has 60 minutes or seconds, or more; type it with fewer than 60"),
    translatable("degree"),
    translatable("minute"),
    translatable("the request to seat the unit in {} was answered {}"),
    translatable("the request to seat the unit in {} was not answered"),
    translatable("the request to set the head to {} was answered {}"),
    translatable("seat it and resume the run"),
    translatable("set it and resume the run"),
    # how a run ends
    translatable("the programme was carried out"),
    translatable("the operator stopped the run"),
    translatable("{} complete point kept in {}"),
    translatable("{} complete points kept in {}"),
    translatable("tumble resume goes on"),
    translatable("a fault of the program: {}"),
    translatable("report it, then resume the run"),
    # warnings of points
    translatable("point {} ({} at {} deg): {} of {} samples are overloads or no numbers"),
    translatable("the point will be set aside"),
    translatable("point {} ({} at {} deg): the output had not settled after {}"),
    translatable("the point is kept and marked"),
    # the head
    translatable("dividing head: {}"),
    translatable("simulated head: {}"),
    translatable("voltmeter: {}"),
    translatable("stand: {}"),
    translatable("is not connected"),
    translatable("connect it first"),
    translatable("has lost its reference"),
    translatable("look at its power supply, then resume the run"),
    translatable("cannot be brought to rest"),
    translatable("switch it off and look at it"),
    translatable("its standstill could not be read back"),
    translatable("look at it before you touch it"),
    translatable("was told to find its reference, and has not found it in time"),
    translatable("look at its home sensor and at its drive, then resume the run"),
    translatable("was to stand at {} deg for a dwell, and is at {} deg after it"),
    translatable("look for what turns it, then resume the run"),
    translatable("still moves at {} deg when it should long have stood at {} deg"),
    translatable("stands at {} deg when it should long have stood at {} deg"),
    translatable("look for what blocks it, check its drive and speed, then resume the run"),
    translatable("does not answer"),
    translatable("check its cable, then resume the run"),
    translatable("nothing was measured"),
    translatable("the recording failed: {}"),
    translatable("then resume the run"),
    # stands and their certificates
    translatable("stand {}: the calibration of the head was due on {}"),
    translatable("stand {}: the calibration of the daq was due on {}"),
    translatable("have it done"),
)
"""Every one is a key of the catalogue; more are added here, and nowhere else."""
