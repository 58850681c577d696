"""Write one table of the bank and its truth.

python -m benchmarks.bank --design bfd --effect k_xx --visible 20 --seed 3 --out t.csv
"""

import argparse
from pathlib import Path

from benchmarks.bank.files import write_csv, write_truth
from benchmarks.bank.noise import KINDS
from benchmarks.bank.table import Spec, make_table


def _arguments() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.bank", description=__doc__)
    parser.add_argument("--design", default="bfd", help="letters of the blocks: f s b q d r e E n, and t for a ramp")
    parser.add_argument("--realisations", type=int, default=5)
    parser.add_argument("--effect", action="append", default=[], help="name of an effect; may be repeated")
    parser.add_argument("--visible", type=float, default=30.0, help="visible signal of each effect, in noise units")
    parser.add_argument("--noise", choices=sorted(KINDS), default="white")
    parser.add_argument("--noise-v", type=float, default=1e-4, help="noise of a dwell, in volts")
    parser.add_argument("--quantum-v", type=float, default=0.0, help="resolution of the readings, in volts")
    parser.add_argument("--leave-out", action="append", default=[], help="column to leave out; may be repeated")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=Path, required=True, help="CSV file; the truth goes beside it as .truth.json")
    return parser


def main() -> None:
    """Make the table that the command line asks for."""
    parser = _arguments()
    given = parser.parse_args()
    spec = Spec(
        design=given.design,
        realisations=given.realisations,
        effects=tuple((name, given.visible) for name in given.effect),
        noise=given.noise,
        noise_v=given.noise_v,
        quantum_v=given.quantum_v,
        left_out=tuple(given.leave_out),
    )
    try:
        case = make_table(spec, given.seed)
    except ValueError as error:
        parser.error(str(error))
    if case is None:
        parser.error(f"design {spec.design} cannot show that within the physical maximum of the effect")
    write_csv(case, given.out)
    write_truth(case, given.out.with_suffix(".truth.json"))


if __name__ == "__main__":
    main()
