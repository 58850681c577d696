"""What to measure where values rest on something that was not measured: a sweep in a mount that settles it."""

from collections.abc import Iterator

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.sentences import series
from tumble.calibrations.methods.dividing_head.probes import PROBES
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.tracing.experiments import Experiment
from tumble.messages import Message


def settling(calibration: Calibration) -> tuple[Experiment, ...]:
    """One sweep for all values that the same mount would settle; nothing where none rests on anything."""
    resting = [each for each in calibration.parameters.values() if each.settled_by]
    mounts = list(dict.fromkeys(mount for each in resting for mount in each.settled_by))
    return tuple(_sweeps(resting, mounts))


def _sweeps(resting: list[Parameter], mounts: list[str]) -> Iterator[Experiment]:
    probes = {each.programme.removeprefix("probe-"): each for each in PROBES}
    for mount in [mount for mount in mounts if mount in probes][:1]:
        settled = [each for each in resting if mount in each.settled_by]
        probe = probes[mount]
        yield Experiment(
            separates=tuple(dict.fromkeys(each.rests_on or each.name for each in settled)),
            programme=probe.programme,
            why=Message(
                "a sweep in {mount} settles {names}, with what was measured",
                mount=mount,
                names=series([each.name for each in settled]),
            ),
            command=f"tumble run --programme {probe.programme} --serial SERIAL",
            separation=0.0,
            stand_time_s=probe.stand_time_s,
        )
