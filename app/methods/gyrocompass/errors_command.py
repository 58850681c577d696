"""`tumble gyrocompass-errors`: what each error costs in heading and drift, and which positions do."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, fields, replace
from pathlib import Path
from typing import Any

import click

from tumble.app.commands import options
from tumble.app.sections import show_sections
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.gyrocompass.error_table import PUBLISHED, RUNS, Conditions, Cost, error_table
from tumble.calibrations.methods.gyrocompass.expected import DriftNoise
from tumble.calibrations.methods.gyrocompass.orders import ORDERS, Way, way, ways_to
from tumble.messages import Message

_SHORTEST_S = 1e-3
_FINEST_DEG = 1e-6
_Command = Callable[..., None]


def _size(flag: str, name: str, default: float, said: str, least: float = 0.0) -> Callable[[_Command], _Command]:
    """An option that is a size."""
    kind = click.FloatRange(min=least)
    return click.option(flag, name, default=default, show_default=True, type=kind, callback=options.finite, help=said)


@click.command("gyrocompass-errors")
@click.option(
    "--latitude",
    "latitude_deg",
    default=PUBLISHED.latitude_deg,
    show_default=True,
    type=click.FloatRange(-89.0, 89.0),
    help="Degrees.",
)
@_size("--dwell", "dwell_s", PUBLISHED.dwell_s, "Averaging at each position, s.", least=_SHORTEST_S)
@_size("--turn", "turn_s", PUBLISHED.turn_s, "From one position to the next, s.")
@_size("--gauss-markov", "gauss_markov_deg_h", PUBLISHED.gauss_markov_deg_h, "Random drift, °/h (1σ).")
@_size("--correlation", "correlation_s", PUBLISHED.correlation_s, "Its correlation time, s.", least=_SHORTEST_S)
@_size("--angle-random-walk", "angle_random_walk_deg_sqrt_h", 0.0, "N of the gyro, °/√h.")
@_size("--bias-instability", "bias_instability_deg_h", 0.0, "B of the gyro, °/h.")
@_size("--rate-random-walk", "rate_random_walk_deg_h_sqrt_h", 0.0, "K of the gyro, °/h/√h.")
@_size("--target", "target_deg", 0.1, "Heading wanted, ° (1σ).", least=_FINEST_DEG)
@click.option("--runs", default=RUNS, show_default=True, type=click.IntRange(100, 1_000_000), help="Simulated runs.")
@click.option("--seed", default=2008, show_default=True, type=click.IntRange(min=0), help="Of the simulation.")
@options.json_out
def command(target_deg: float, runs: int, seed: int, json_path: Path | None, **given: float) -> None:
    """What the errors of gyrocompassing cost, and which positions, in which order, for how long, reach a heading.

    The conditions that have no option are those of Meleshko, Kornejchuk, Skudneva 2008: azimuth 6′ and 3′, tilt 10′ and
    1′, latitude 0.1′.
    """
    latitude_deg, dwell_s, turn_s = (given[name] for name in ("latitude_deg", "dwell_s", "turn_s"))
    noise = DriftNoise(**{each.name: given[each.name] for each in fields(DriftNoise)})
    if not any((noise.gauss_markov_deg_h, noise.angle_random_walk_deg_sqrt_h, noise.bias_instability_deg_h)):
        raise click.UsageError(
            Message("a gyro has noise: give --gauss-markov, --angle-random-walk or --bias-instability a size above 0")
        )
    conditions = replace(
        PUBLISHED,
        latitude_deg=latitude_deg,
        dwell_s=dwell_s,
        turn_s=turn_s,
        gauss_markov_deg_h=noise.gauss_markov_deg_h,
        correlation_s=noise.correlation_s,
    )
    costs = error_table(conditions, runs, seed)
    ways = [each for order in ORDERS if (each := way(order, dwell_s, turn_s, latitude_deg, noise)) is not None]
    quickest = ways_to(target_deg, turn_s, latitude_deg, noise)
    if str(json_path) != "-":
        show_sections(_sections(costs, ways, quickest, target_deg))
    options.write_json(_document(conditions, costs, ways, quickest), json_path)


def _sections(
    costs: Sequence[Cost], ways: Sequence[Way], quickest: Sequence[Way], target_deg: float
) -> Iterator[Section]:
    yield Section(
        title=Message("What each error costs in three positions (0/90/180°)"),
        headings=(
            Message("Cause"),
            Message("Heading, r.m.s. (′)"),
            Message("95% within (°)"),
            Message("within 0.1°"),
            Message("Drift, r.m.s. (°/h)"),
            Message("mean (°/h)"),
        ),
        rows=[_cost_row(each) for each in costs],
        brief=True,
    )
    yield Section(
        title=Message("Orders of one pass, by generalised least squares"),
        headings=(Message("Order"), Message("Minutes"), Message("Heading, r.m.s. (°)"), Message("at worst (°)")),
        rows=[_way_row(each)[:1] + _way_row(each)[3:] for each in ways],
        brief=True,
    )
    yield Section(
        title=Message("Quickest to {target:g}°", target=target_deg),
        headings=(
            Message("Order"),
            Message("Passes"),
            Message("Averaging (s)"),
            Message("Minutes"),
            Message("Heading, r.m.s. (°)"),
            Message("at worst (°)"),
        ),
        rows=[_way_row(each) for each in quickest],
        lines=() if quickest else (Message("No order that was tried reaches it, or the drift does not wander."),),
        brief=True,
    )


def _cost_row(cost: Cost) -> tuple[str, ...]:
    return (
        cost.cause,
        f"{cost.heading_rms_arcmin:.2f}",
        f"{cost.heading_95_deg:.3f}",
        f"{100.0 * cost.within_tenth:.0f} %",
        f"{cost.drift_rms_deg_h:.4f}",
        f"{cost.drift_mean_deg_h:.4f}",
    )


def _way_row(way: Way) -> tuple[str, ...]:
    return (
        way.order,
        f"{way.passes}",
        f"{way.dwell_s:g}",
        f"{way.minutes:.1f}",
        f"{way.heading.rms_deg:.3f}",
        f"{way.heading.worst_deg:.3f}",
    )


def _document(
    conditions: Conditions, costs: Sequence[Cost], ways: Sequence[Way], quickest: Sequence[Way]
) -> dict[str, Any]:
    return {
        "schema": "tumble.gyrocompass-errors/1",
        "conditions": asdict(conditions),
        "causes": [{**asdict(each), "drift_rms_deg_h": each.drift_rms_deg_h} for each in costs],
        "orders": [asdict(each) for each in ways],
        "quickest": [asdict(each) for each in quickest],
    }
