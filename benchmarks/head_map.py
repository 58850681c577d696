"""A head map learned from two units on a simulated head, and what it does for a third.

    python -m benchmarks.head_map --seeds reported --count 20 [--programme reversal] [--noise-v 1e-3]

Every head is drawn from its seed: by turns one with effects of the catalogue (eccentricity, second harmonic,
graduation, backlash), and one whose error is a function of its own (`head_error` of the stand file: a worm, a bump, a
bent circle).
Three units with parameters of their own are calibrated on it. The map that two of them give is held against the truth,
the mean over a turn removed; then the third unit is corrected by it, and its error on held-out realisations compared.
"""

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from benchmarks.bank import DEVELOPMENT, REPORTED
from tumble.app.analysing import fit, trace
from tumble.app.learning import learn
from tumble.app.measurement import Measurement
from tumble.app.measurements import read_measurement
from tumble.app.running import Job, failure, run
from tumble.app.stand import LoadedStand, load_stand
from tumble.app.stand_records import corrected_by
from tumble.app.wiring import connect
from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.stand_records.head_map import HeadMap
from tumble.calibrations.stand_records.record import StandRecord, Status
from tumble.drivers.simulated.external import load_function
from tumble.drivers.simulated.head import HeadErrors
from tumble.procedures.programmes import load_programme

_SEEDS = {"development": DEVELOPMENT, "reported": REPORTED}
_FIRST = 960_000
"""Beyond the seeds of the lists of the bank."""
_LARGEST_DEG = {"eccentricity": 0.1, "second": 0.1, "graduation": 0.05, "backlash": 0.1}
"""As in `benchmarks.bank.catalogue`."""
_SMALLEST = 0.1
"""Of these: a head error of a few seconds of arc."""
_STAND = """\
name = "bench"
[head]
driver = "simulated"
limits_deg = [-180.0, 760.0]
serial = "H-1"
[daq]
driver = "simulated"
serial = "D-1"
[simulated]
seed = {seed}
noise_v = {noise_v}
parameters = {{ {parameters} }}
{error}
"""
_OUTSIDE = """\
import math


def head_error(angle_deg, direction, time_s):
    phase = math.radians(angle_deg)
    worm = math.asin(math.sin({teeth} * phase + {worm_phase})) * 2.0 / math.pi
    away_deg = (angle_deg - {centre_deg} + 180.0) % 360.0 - 180.0
    bump = math.exp(-0.5 * (away_deg / {width_deg}) ** 2)
    bent = math.sin(phase + {bent_phase} + 0.3 * math.sin(phase))
    return {worm_deg} * worm + {bump_deg} * bump + {bent_deg} * bent + ({backlash_deg} if direction < 0 else 0.0)
"""


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """One head."""

    seed: int
    kind: str
    rms_deg: float
    """Of the error of the head over a turn, mean removed."""
    left: float | None
    """Root mean square of true error minus map, over that of the true error; None where no map came into force."""
    stated: float | None
    """Standard uncertainty of the map (root mean square over a turn), over the same."""
    before_v: float
    """Error on held-out realisations of the last unit, not corrected."""
    after_v: float | None
    """The same, corrected."""


def outcomes(seeds: Sequence[int], programme: str, noise_v: float) -> Iterator[Outcome]:
    """One head after the other."""
    for number, seed in enumerate(seeds):
        with TemporaryDirectory() as folder:
            yield _outcome(seed, "outside" if number % 2 else "catalogue", Path(folder), programme, noise_v)


def _outcome(seed: int, kind: str, folder: Path, programme: str, noise_v: float) -> Outcome:
    rng = np.random.default_rng(seed)
    error = _outside(rng, folder) if kind == "outside" else _catalogue(rng)
    stands = [_stand(rng, folder, f"{seed + 10_000 * unit}", error, noise_v) for unit in range(3)]
    truth_deg = _truth_deg(stands[0])
    runs = [_measured(stand, folder / f"unit-{number}.mcap", programme) for number, stand in enumerate(stands)]
    records = [learn(trace(fit(each, trials=0)), folder / "store").record for each in runs[:2]]
    record = next((each for each in records if each and each.status is Status.IN_FORCE), None)
    head_map = record.corrections.head_map if record else None
    rms_deg = float(np.std(truth_deg))
    return Outcome(
        seed=seed,
        kind=kind,
        rms_deg=rms_deg,
        left=float(np.std(truth_deg - head_map.error_deg(_TURN_DEG))) / rms_deg if head_map else None,
        stated=_stated_deg(head_map) / rms_deg if head_map else None,
        before_v=_held_out_v(runs[2], None),
        after_v=_held_out_v(runs[2], record) if record else None,
    )


_TURN_DEG: FloatArray = np.arange(0.0, 360.0, 0.5)


def _stated_deg(head_map: HeadMap) -> float:
    return float(np.sqrt(np.mean(head_map.standard_uncertainty_deg(_TURN_DEG) ** 2)))


def _held_out_v(measurement: Measurement, record: StandRecord | None) -> float:
    corrected = corrected_by(record, measurement) if record else measurement
    held_out_v = fit(corrected, trials=0).calibration.held_out_rms_v
    assert held_out_v is not None, "every programme here has several realisations"
    return held_out_v


def _truth_deg(stand: LoadedStand) -> FloatArray:
    """Error of the head after moves in + direction, as the simulated head has it."""
    simulated = stand.file.simulated
    assert simulated is not None
    external = load_function(simulated.head_error, stand.folder) if simulated.head_error else None
    return HeadErrors(simulated.effects, external).error_deg(_TURN_DEG, 1, np.zeros(1))


def _measured(stand: LoadedStand, recording: Path, programme: str) -> Measurement:
    job = Job(stand=stand, programme=load_programme(programme), serial_number=recording.stem)
    outcome = run(job, connect(stand), recording)
    if error := failure(outcome, recording):
        raise error
    return read_measurement(recording)


def _stand(rng: np.random.Generator, folder: Path, seed: str, error: str, noise_v: float) -> LoadedStand:
    """The same head with another unit."""
    spreads = {"kx": 0.05, "ky": 0.01, "kz": 0.01, "kxy": 1e-3, "alpha0_deg": 0.3}
    drawn = {name: float(rng.normal(0.0, spread)) for name, spread in spreads.items()}
    drawn["kx"] += 1.0
    parameters = ", ".join(f"{name} = {value:.6g}" for name, value in {"u0": 2.5, **drawn}.items())
    path = folder / f"stand-{seed}.toml"
    path.write_text(_STAND.format(seed=seed, noise_v=noise_v, parameters=parameters, error=error), "utf-8")
    return load_stand(path)


def _size_deg(rng: np.random.Generator, name: str) -> float:
    """From a tenth of the largest to the largest, evenly on a logarithmic scale."""
    return float(_LARGEST_DEG[name] * _SMALLEST ** rng.uniform())


def _catalogue(rng: np.random.Generator) -> str:
    """The `effects` of a stand file: eccentricity, and each of the others in two of three heads."""

    def wave(name: str, more: str = "") -> str:
        return f"{{ {more}amplitude_deg = {_size_deg(rng, name):.6f}, phase_deg = {rng.uniform(0.0, 360.0):.2f} }}"

    effects = [f"head_eccentricity = {wave('eccentricity')}"]
    if rng.uniform() < 2 / 3:
        effects.append(f"head_second_harmonic = {wave('second')}")
    if rng.uniform() < 2 / 3:
        effects.append(f"graduation = {wave('graduation', f'order = {rng.integers(3, 13)}, ')}")
    if rng.uniform() < 2 / 3:
        effects.append(f"backlash = {rng.choice([-1.0, 1.0]) * _size_deg(rng, 'backlash'):.6f}")
    return f"effects = {{ {', '.join(effects)} }}"


def _outside(rng: np.random.Generator, folder: Path) -> str:
    """A `head_error` of its own."""
    drawn = {
        "teeth": int(rng.integers(3, 8)),
        "worm_phase": float(rng.uniform(0.0, 2 * np.pi)),
        "centre_deg": float(rng.uniform(0.0, 360.0)),
        "width_deg": float(rng.uniform(12.0, 40.0)),
        "bent_phase": float(rng.uniform(0.0, 2 * np.pi)),
        "worm_deg": _size_deg(rng, "graduation"),
        "bump_deg": _size_deg(rng, "second"),
        "bent_deg": _size_deg(rng, "eccentricity"),
        "backlash_deg": _size_deg(rng, "backlash"),
    }
    (folder / "physics.py").write_text(_OUTSIDE.format(**drawn), "utf-8")
    return 'head_error = "physics.py:head_error"'


def report(found: Sequence[Outcome]) -> str:
    """Every head, and how many maps are within a tenth."""
    lines = [
        "| seed | head | error, r.m.s. | left / error | stated u / error | third unit, held out | corrected |",
        "|---|---|---|---|---|---|---|",
    ]
    lines += [
        f"| {each.seed} | {each.kind} | {each.rms_deg * 3600:.1f}″ | {_ratio(each.left)} | {_ratio(each.stated)} "
        f"| {each.before_v * 1e6:.1f} µV | {'' if each.after_v is None else f'{each.after_v * 1e6:.1f} µV'} |"
        for each in found
    ]
    return "\n".join([*lines, "", *(_summary(found, kind) for kind in ("catalogue", "outside"))])


def _ratio(value: float | None) -> str:
    return "no map" if value is None else f"{value:.3f}"


def _summary(found: Sequence[Outcome], kind: str) -> str:
    here = [each for each in found if each.kind == kind]
    left = [each.left for each in here if each.left is not None]
    good = sum(value <= 0.1 for value in left)
    middle = f", median {np.median(left):.3f}, largest {max(left):.3f}" if left else ""
    return f"{kind}: {len(left)} maps of {len(here)} heads, {good} within a tenth of the error{middle}"


def main() -> None:
    """Learn maps and print how good they are."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.head_map",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--seeds", choices=sorted(_SEEDS), default="development")
    parser.add_argument("--count", type=int, default=10)
    parser.add_argument("--programme", default="reversal", help="name of a shipped programme, or a file")
    parser.add_argument("--noise-v", type=float, default=1e-3, help="of one sample; a dwell is the mean of a hundred")
    given = parser.parse_args()
    first = _SEEDS[given.seeds][_FIRST]
    print(report(list(outcomes(range(first, first + given.count), given.programme, given.noise_v))))


if __name__ == "__main__":
    main()
