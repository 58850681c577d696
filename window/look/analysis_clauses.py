"""Clauses of the analysis that the window can say in another language; braces stand for anything."""

from typing import Final

from PySide6.QtCore import QT_TRANSLATE_NOOP

ANALYSIS_CLAUSES: Final[tuple[str, ...]] = (  # type: ignore[assignment]  # the stub says object, and it is the text
    # what was found
    QT_TRANSLATE_NOOP("Clauses", "What the declared model leaves was traced to {}"),
    QT_TRANSLATE_NOOP("Clauses", "What that does to the parameters is said below the results"),
    QT_TRANSLATE_NOOP("Clauses", "No effect of the catalogue explains what depends on {}: {}"),
    QT_TRANSLATE_NOOP("Clauses", "Read or set wrong by a round amount: {}"),
    QT_TRANSLATE_NOOP("Clauses", "Nothing was traced: {}"),
    QT_TRANSLATE_NOOP("Clauses", "{} rows are too few"),
    QT_TRANSLATE_NOOP("Clauses", "at least {} are needed"),
    QT_TRANSLATE_NOOP("Clauses", "With that taken into account the poses agree with the model (lack of fit: p {})"),
    QT_TRANSLATE_NOOP(
        "Clauses", "With that taken into account the poses still disagree with the model (lack of fit: p {})"
    ),
    QT_TRANSLATE_NOOP(
        "Clauses",
        "Neither an effect of the catalogue nor any other structure was found, yet the poses disagree with the "
        "declared model by more than the repeats explain (lack of fit: p {})",
    ),
    QT_TRANSLATE_NOOP(
        "Clauses",
        "Nothing is left that the scatter of the data does not explain: neither an effect of the catalogue nor any "
        "other structure stands out of it",
    ),
    # before and after
    QT_TRANSLATE_NOOP("Clauses", "residual, r.m.s."),
    QT_TRANSLATE_NOOP("Clauses", "held-out error, r.m.s."),
    QT_TRANSLATE_NOOP("Clauses", "lack of fit, p"),
    QT_TRANSLATE_NOOP("Clauses", "not tested"),
    QT_TRANSLATE_NOOP("Clauses", "none"),
    QT_TRANSLATE_NOOP("Clauses", "cannot be told"),
    QT_TRANSLATE_NOOP("Clauses", "{}, given alpha0 = {}"),
    QT_TRANSLATE_NOOP("Clauses", "given alpha0 = {}"),
    QT_TRANSLATE_NOOP("Clauses", "rests on {}"),
    QT_TRANSLATE_NOOP("Clauses", "unit"),
    QT_TRANSLATE_NOOP("Clauses", "stand"),
    QT_TRANSLATE_NOOP("Clauses", "DAQ"),
    # limits
    QT_TRANSLATE_NOOP("Clauses", "inside"),
    QT_TRANSLATE_NOOP("Clauses", "outside"),
    QT_TRANSLATE_NOOP("Clauses", "not decided"),
    QT_TRANSLATE_NOOP("Clauses", "not decided: no value"),
    QT_TRANSLATE_NOOP("Clauses", "inside, but the interval reaches out"),
    QT_TRANSLATE_NOOP("Clauses", "outside, but the interval reaches in"),
    # what cannot be told
    QT_TRANSLATE_NOOP("Clauses", "This data cannot tell {}"),
    QT_TRANSLATE_NOOP("Clauses", "the table of results says why"),
    QT_TRANSLATE_NOOP("Clauses", "its 95% interval is unbounded: {}"),
    QT_TRANSLATE_NOOP("Clauses", "no row has gravity along {}, or nothing parts it from another parameter"),
    QT_TRANSLATE_NOOP("Clauses", "no row has gravity along Ox and Oy at once"),
    QT_TRANSLATE_NOOP("Clauses", "the rows do not part it from the other parameters"),
    QT_TRANSLATE_NOOP(
        "Clauses", "its 95% interval reaches 45 deg: only kxy parts it from ky and kz here, and kxy is not large enough"
    ),
    QT_TRANSLATE_NOOP(
        "Clauses", "its 95% interval reaches 45 deg: only kxy parts it from ky and kz here, and kxy cannot be told"
    ),
    QT_TRANSLATE_NOOP(
        "Clauses", "told through the curvature kxy alone, which an undeclared second-order term imitates"
    ),
    QT_TRANSLATE_NOOP("Clauses", "{} rest on {} alone: {}"),
    QT_TRANSLATE_NOOP("Clauses", "{} rests on {} alone: {}"),
    QT_TRANSLATE_NOOP("Clauses", "a sweep in {} would settle it"),
    QT_TRANSLATE_NOOP("Clauses", "The recording is incomplete: the result rests on the rows before it was cut off"),
    QT_TRANSLATE_NOOP("Clauses", "The program that computed this had changes that are in no commit"),
    QT_TRANSLATE_NOOP(
        "Clauses",
        "The declared model does not describe the data: the poses disagree with it by more than the repeats explain "
        "(p {})",
    ),
    QT_TRANSLATE_NOOP("Clauses", "The uncertainties rest on that disagreement"),
    QT_TRANSLATE_NOOP("Clauses", "{}: the declared model does not describe the poses (lack of fit, p = {})"),
    QT_TRANSLATE_NOOP("Clauses", "uncertainties rest on that disagreement"),
    # the next experiment
    QT_TRANSLATE_NOOP("Clauses", "{}: {} then differs from {} by {} in -2 ln L"),
    QT_TRANSLATE_NOOP("Clauses", "{}: {} then differs from {} by {} in -2 ln L, if {} is the true one"),
    QT_TRANSLATE_NOOP("Clauses", "at least {}"),
    QT_TRANSLATE_NOOP("Clauses", "only together with {}"),
    QT_TRANSLATE_NOOP("Clauses", "run it {} times"),
    QT_TRANSLATE_NOOP("Clauses", "{} visits the same poses again, at the temperature as it is now"),
    QT_TRANSLATE_NOOP("Clauses", "{} visits every pose from both sides"),
    QT_TRANSLATE_NOOP("Clauses", "{} turns Oy over and leaves Ox and the head as they are"),
    QT_TRANSLATE_NOOP(
        "Clauses", "{} turns Ox by 90° on the head, so that errors of the head fall on other values of ax"
    ),
    QT_TRANSLATE_NOOP("Clauses", "{} puts Oz in the place of Oy"),
    QT_TRANSLATE_NOOP("Clauses", "{} puts Oz in the place of Oy, turned over"),
    QT_TRANSLATE_NOOP("Clauses", "{} takes ax away and leaves ay and az"),
    QT_TRANSLATE_NOOP(
        "Clauses", "{} takes the angles in no order, so that neither time nor the dwell before goes with them"
    ),
    QT_TRANSLATE_NOOP("Clauses", "{} visits the same poses again, two hours later"),
    QT_TRANSLATE_NOOP("Clauses", "{} visits the same poses with the unit 10 K warmer"),
    # two records
    QT_TRANSLATE_NOOP("Clauses", "{} cannot be compared: {}"),
    QT_TRANSLATE_NOOP("Clauses", "{} changed by {}, standard uncertainty {}: significant (p = {})"),
    QT_TRANSLATE_NOOP("Clauses", "{} changed by {}, standard uncertainty {}: not significant (p = {})"),
    QT_TRANSLATE_NOOP(
        "Clauses",
        "{} changed by {}, standard uncertainty {}: both records come from one raw file, so this is what the analysis "
        "changed",
    ),
    QT_TRANSLATE_NOOP("Clauses", "{} did not change: both records come from one raw file"),
    QT_TRANSLATE_NOOP("Clauses", "Raw file {}: intact"),
    QT_TRANSLATE_NOOP("Clauses", "Raw file {}: changed"),
    QT_TRANSLATE_NOOP("Clauses", "Raw file {}: missing"),
    QT_TRANSLATE_NOOP("Clauses", "Altered in the store: {}"),
    QT_TRANSLATE_NOOP("Clauses", "The record is intact"),
    QT_TRANSLATE_NOOP("Clauses", "Nothing was fitted again"),
    QT_TRANSLATE_NOOP("Clauses", "Fitted again, these do not come back: {}"),
)
"""Every one is a context for `lupdate`; more are added here, and nowhere else."""
