"""What is made of the cases: how many the loop tells apart, in how many experiments, in how much time at the stand."""

from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np

from benchmarks.active.oracle import CLOSE
from tumble.calibrations.tracing.chain import Ended

Record = dict[str, Any]


def distinguishable(record: Record) -> bool:
    """Whether as many runs as the loop may make leave the right name without a rival in 95 of 100 noises.

    What has no name can be located where the loop did it, or all experiments there are do it in two noises.
    """
    if "expected" in record:
        return min(least for least, _ in record["expected"].values()) >= CLOSE
    return told(record) or all([record["effect"]] in record[found] for found in _EVERYTHING)


def indistinguishable(record: Record) -> bool:
    """Whether some rival stays beside the right name after them, in 95 of 100 noises; or in two, without a name."""
    if "expected" in record:
        return min(most for _, most in record["expected"].values()) <= CLOSE
    return not told(record) and all(
        any(record["effect"] in names and len(names) > 1 for names in record[found]) for found in _EVERYTHING
    )


_EVERYTHING = ("everything_found", "again_found")


def told(record: Record) -> bool:
    """Whether the loop leaves nothing but the right name."""
    return record["found"] == [[record["effect"]]]


def said_so(record: Record) -> bool:
    """Whether the loop says that nothing available tells the right name from its rivals.

    Or that what was to tell them told nothing.
    """
    found = record["found"]
    left = len(found) == 1 and record["effect"] in found[0] and len(found[0]) > 1
    return left and record["ended"] in {Ended.NOTHING_AVAILABLE, Ended.NOT_AS_PROMISED}


def report(records: Sequence[Record]) -> str:
    """The figures."""
    ambiguous = [record for record in records if record["ambiguous"]]
    partable = [record for record in ambiguous if distinguishable(record)]
    never = [record for record in ambiguous if indistinguishable(record)]
    between = [each for each in ambiguous if each not in partable and each not in never]
    failed = [record for record in records if record["failure"]]
    lines = [
        f"{len(records)} cases, {sum(each['open'] for each in records)} of them visible and open to doubt, "
        f"{len(failed)} failed, {len(ambiguous)} ambiguous after the first programme",
        _share("some available experiment parts the rivals, told apart", partable, told),
        _share("  of these with a physics file", [each for each in partable if each["outside"]], told),
        _share("nothing available parts the rivals, said so", never, said_so),
        _share("  of these with a physics file", [each for each in never if each["outside"]], said_so),
        _share("the noise decides, told apart or said so", between, lambda each: told(each) or said_so(each)),
    ]
    if done := [record for record in partable if told(record)]:
        counts = [len(record["experiments"]) for record in done]
        part = [record["stand_time_s"] / record["everything_s"] for record in done]
        minutes = [[record[key] / 60 for record in done] for key in ("stand_time_s", "everything_s")]
        lines += [
            f"further experiments: {np.median(counts):.0f} in the median, {dict(sorted(Counter(counts).items()))}",
            f"stand time of these: {np.median(minutes[0]):.0f} min in the median, against {np.median(minutes[1]):.0f} "
            f"min for every experiment; {100 * np.median(part):.1f}% in the median",
            f"a case took {np.median([record['seconds'] for record in records]):.1f} s in the median",
        ]
    return "\n".join(lines)


def _share(words: str, records: Sequence[Record], good: Any) -> str:  # one of the above
    count = sum(map(good, records))
    return f"{words}: {count} of {len(records)}" + (f" ({100 * count / len(records):.1f}%)" if records else "")


def failures(records: Sequence[Record]) -> list[str]:
    """A line for each case that went wrong, or that nobody can judge."""
    lines = []
    for record in records:
        words = f"seed {record['seed']}: {record['effect']} ({record['first']}, {record['seat']})"
        if record["failure"]:
            lines.append(f"{words}: {record['failure']}")
        elif record["ambiguous"] and not _good(record):
            lines.append(
                f"{words}: before {record['before']}, ran {record['experiments']} {record['differences']}, found "
                f"{record['found']} ({record['ended']}: {record['why']}); {_could(record)}"
            )
    return lines


def _good(record: Record) -> bool:
    """Told where it can be; said so where it cannot; between, one of the two."""
    if distinguishable(record):
        return told(record)
    return said_so(record) or (told(record) and not indistinguishable(record))


def _could(record: Record) -> str:
    """What could be found out."""
    if "expected" not in record:
        return f"everything finds {[record.get(found) for found in _EVERYTHING]}"
    near = {name: behind for name, behind in record["expected"].items() if behind[0] < 4.0 * CLOSE}
    return f"after {record['best']} -2 ln L is from and to {near}"
