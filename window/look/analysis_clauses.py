"""Clauses of the analysis that the window can say in another language; braces stand for anything."""

from typing import Final

from tumble.messages import translatable

ANALYSIS_CLAUSES: Final[tuple[str, ...]] = (
    # what was found
    translatable("What the declared model leaves was traced to {}"),
    translatable("What that does to the parameters is said below the results"),
    translatable("No effect of the catalogue explains what depends on {}: {}"),
    translatable("Read or set wrong by a round amount: {}"),
    translatable("Nothing was traced: {}"),
    translatable("{} rows are too few"),
    translatable("at least {} are needed"),
    translatable("With that taken into account the poses agree with the model (lack of fit: p {})"),
    translatable("With that taken into account the poses still disagree with the model (lack of fit: p {})"),
    translatable(
        "Neither an effect of the catalogue nor any other structure was found, yet the poses disagree with the "
        "declared model by more than the repeats explain (lack of fit: p {})",
    ),
    translatable(
        "Nothing is left that the scatter of the data does not explain: neither an effect of the catalogue nor any "
        "other structure stands out of it",
    ),
    # before and after
    translatable("residual, r.m.s."),
    translatable("held-out error, r.m.s."),
    translatable("lack of fit, p"),
    translatable("not tested"),
    translatable("none"),
    translatable("cannot be told"),
    translatable("{}, given alpha0 = {}"),
    translatable("given alpha0 = {}"),
    translatable("rests on {}"),
    translatable("unit"),
    translatable("stand"),
    translatable("DAQ"),
    # limits
    translatable("inside"),
    translatable("outside"),
    translatable("not decided"),
    translatable("not decided: no value"),
    translatable("inside, but the interval reaches out"),
    translatable("outside, but the interval reaches in"),
    # what cannot be told
    translatable("This data cannot tell {}"),
    translatable("the table of results says why"),
    translatable("its 95% interval is unbounded: {}"),
    translatable("no row has gravity along {}, or nothing parts it from another parameter"),
    translatable("no row has gravity along Ox and Oy at once"),
    translatable("the rows do not part it from the other parameters"),
    translatable("its 95% interval reaches 45 deg: only kxy parts it from ky and kz here, and kxy is not large enough"),
    translatable("its 95% interval reaches 45 deg: only kxy parts it from ky and kz here, and kxy cannot be told"),
    translatable("told through the curvature kxy alone, which an undeclared second-order term imitates"),
    translatable("{} rest on {} alone: {}"),
    translatable("{} rests on {} alone: {}"),
    translatable("a sweep in {} would settle it"),
    translatable("The recording is incomplete: the result rests on the rows before it was cut off"),
    translatable("The program that computed this had changes that are in no commit"),
    translatable(
        "The declared model does not describe the data: the poses disagree with it by more than the repeats explain "
        "(p {})",
    ),
    translatable("The uncertainties rest on that disagreement"),
    translatable("{}: the declared model does not describe the poses (lack of fit, p = {})"),
    translatable("uncertainties rest on that disagreement"),
    # the next experiment
    translatable("{}: {} then differs from {} by {} standard deviations"),
    translatable("{}: {} then differs from {} by {} standard deviations, if {} is the true one"),
    translatable("at least {}"),
    translatable("only together with {}"),
    translatable("run it {} times"),
    translatable("{} visits the same poses again, at the temperature as it is now"),
    translatable("{} visits every pose from both sides"),
    translatable("{} turns Oy over and leaves Ox and the head as they are"),
    translatable("{} turns Ox by 90° on the head, so that errors of the head fall on other values of ax"),
    translatable("{} puts Oz in the place of Oy"),
    translatable("{} puts Oz in the place of Oy, turned over"),
    translatable("{} takes ax away and leaves ay and az"),
    translatable("{} takes the angles in no order, so that neither time nor the dwell before goes with them"),
    translatable("{} visits the same poses again, two hours later"),
    translatable("{} visits the same poses with the unit 10 K warmer"),
    # two records
    translatable("{} cannot be compared: {}"),
    translatable("{} changed by {}, standard uncertainty {}: significant (p = {})"),
    translatable("{} changed by {}, standard uncertainty {}: not significant (p = {})"),
    translatable(
        "{} changed by {}, standard uncertainty {}: both records come from one raw file, so this is what the analysis "
        "changed",
    ),
    translatable("{} did not change: both records come from one raw file"),
    translatable("Raw file {}: intact"),
    translatable("Raw file {}: changed"),
    translatable("Raw file {}: missing"),
    translatable("Altered in the store: {}"),
    translatable("The record is intact"),
    translatable("Nothing was fitted again"),
    translatable("Fitted again, these do not come back: {}"),
)
"""Every one is a key of the catalogue; more are added here, and nowhere else."""
