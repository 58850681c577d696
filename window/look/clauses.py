"""Clauses of the engine and of the drivers that the window can say in another language; braces stand for anything."""

from typing import Final

from PySide6.QtCore import QT_TRANSLATE_NOOP

CLAUSES: Final[tuple[str, ...]] = (  # type: ignore[assignment]  # the stub says object, and it is the text
    # operator and eyepiece
    QT_TRANSLATE_NOOP("Clauses", "Set the head to {}; Enter when it reads so, or type the reading"),
    QT_TRANSLATE_NOOP(
        "Clauses",
        "You read {}, the setting was {}: type it again to keep it, or set the head right and press Enter",
    ),
    QT_TRANSLATE_NOOP(
        "Clauses",
        "The voltage is {} V off at {} and would fit {}: a wrong {}? Read again and type what you read; Enter keeps it",
    ),
    QT_TRANSLATE_NOOP(
        "Clauses",
        "The voltage is {} V off at {}, which no single wrong digit explains. Read again and type what you read; "
        "Enter keeps it",
    ),
    QT_TRANSLATE_NOOP("Clauses", "{} is no angle; type degrees, minutes and seconds, such as 12 34 56, or 12.5"),
    QT_TRANSLATE_NOOP("Clauses", "{} has a fraction before its last number; type it without"),
    QT_TRANSLATE_NOOP("Clauses", "{} has 60 minutes or seconds, or more; type it with fewer than 60"),
    QT_TRANSLATE_NOOP("Clauses", "degree"),
    QT_TRANSLATE_NOOP("Clauses", "minute"),
    QT_TRANSLATE_NOOP("Clauses", "the request to seat the unit in {} was answered {}"),
    QT_TRANSLATE_NOOP("Clauses", "the request to seat the unit in {} was not answered"),
    QT_TRANSLATE_NOOP("Clauses", "the request to set the head to {} was answered {}"),
    QT_TRANSLATE_NOOP("Clauses", "seat it and resume the run"),
    QT_TRANSLATE_NOOP("Clauses", "set it and resume the run"),
    # how a run ends
    QT_TRANSLATE_NOOP("Clauses", "the programme was carried out"),
    QT_TRANSLATE_NOOP("Clauses", "the operator stopped the run"),
    QT_TRANSLATE_NOOP("Clauses", "{} complete point kept in {}"),
    QT_TRANSLATE_NOOP("Clauses", "{} complete points kept in {}"),
    QT_TRANSLATE_NOOP("Clauses", "tumble resume goes on"),
    QT_TRANSLATE_NOOP("Clauses", "a fault of the program: {}"),
    QT_TRANSLATE_NOOP("Clauses", "report it, then resume the run"),
    # warnings of points
    QT_TRANSLATE_NOOP("Clauses", "point {} ({} at {} deg): {} of {} samples are overloads or no numbers"),
    QT_TRANSLATE_NOOP("Clauses", "the point will be set aside"),
    QT_TRANSLATE_NOOP("Clauses", "point {} ({} at {} deg): the output had not settled after {}"),
    QT_TRANSLATE_NOOP("Clauses", "the point is kept and marked"),
    # the head
    QT_TRANSLATE_NOOP("Clauses", "dividing head: {}"),
    QT_TRANSLATE_NOOP("Clauses", "simulated head: {}"),
    QT_TRANSLATE_NOOP("Clauses", "voltmeter: {}"),
    QT_TRANSLATE_NOOP("Clauses", "stand: {}"),
    QT_TRANSLATE_NOOP("Clauses", "is not connected"),
    QT_TRANSLATE_NOOP("Clauses", "connect it first"),
    QT_TRANSLATE_NOOP("Clauses", "has lost its reference"),
    QT_TRANSLATE_NOOP("Clauses", "look at its power supply, then resume the run"),
    QT_TRANSLATE_NOOP("Clauses", "cannot be brought to rest"),
    QT_TRANSLATE_NOOP("Clauses", "switch it off and look at it"),
    QT_TRANSLATE_NOOP("Clauses", "its standstill could not be read back"),
    QT_TRANSLATE_NOOP("Clauses", "look at it before you touch it"),
    QT_TRANSLATE_NOOP("Clauses", "was told to find its reference, and has not found it in time"),
    QT_TRANSLATE_NOOP("Clauses", "look at its home sensor and at its drive, then resume the run"),
    QT_TRANSLATE_NOOP("Clauses", "was to stand at {} deg for a dwell, and is at {} deg after it"),
    QT_TRANSLATE_NOOP("Clauses", "look for what turns it, then resume the run"),
    QT_TRANSLATE_NOOP("Clauses", "still moves at {} deg when it should long have stood at {} deg"),
    QT_TRANSLATE_NOOP("Clauses", "stands at {} deg when it should long have stood at {} deg"),
    QT_TRANSLATE_NOOP("Clauses", "look for what blocks it, check its drive and speed, then resume the run"),
    QT_TRANSLATE_NOOP("Clauses", "does not answer"),
    QT_TRANSLATE_NOOP("Clauses", "check its cable, then resume the run"),
    QT_TRANSLATE_NOOP("Clauses", "nothing was measured"),
    QT_TRANSLATE_NOOP("Clauses", "the recording failed: {}"),
    QT_TRANSLATE_NOOP("Clauses", "then resume the run"),
    # stands and their certificates
    QT_TRANSLATE_NOOP("Clauses", "stand {}: the calibration of the head was due on {}"),
    QT_TRANSLATE_NOOP("Clauses", "stand {}: the calibration of the daq was due on {}"),
    QT_TRANSLATE_NOOP("Clauses", "have it done"),
)
"""Every one is a context for `lupdate`; more are added here, and nowhere else."""
