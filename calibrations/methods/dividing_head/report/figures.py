"""Plots of the fit itself and of the flips."""

from collections.abc import Iterator

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.flips import FlipClosure
from tumble.calibrations.methods.dividing_head.model import PARAMETERS, basis, coefficients
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.report.subject import mounts_of
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.report.figure import (
    COLOURS,
    MICRO,
    PALE,
    SHAPES,
    Axis,
    Figure,
    Layer,
    Line,
    Marks,
    Panel,
    on_one_scale,
)
from tumble.messages import Message, with_wording

_IN_ROW = 3
"""So many mounts stand beside each other; more in two rows."""


def fit_figure(calibration: Calibration) -> Figure:
    """Output against head angle, one panel a mount, with the model where its parameters draw it."""
    mounts = mounts_of(calibration.observations)
    columns = len(mounts) if len(mounts) <= _IN_ROW else -(-len(mounts) // 2)
    panels = [_fitted(calibration, index, mount, index % columns == 0) for index, mount in enumerate(mounts)]
    return Figure(
        name="fit",
        description=Message(
            "Output against head angle with the fitted model, for {mounts}",
            mounts=Message.joined(", ", map(with_wording, mounts)),
        ),
        panels=on_one_scale(panels),
        columns=columns,
        height=190.0 if len(mounts) <= _IN_ROW else 150.0,
    )


def _fitted(calibration: Calibration, index: int, mount: str, first: bool) -> Panel:
    observations = calibration.observations
    at = observations.mounts == mount
    layers: list[Layer] = []
    curve = model_curve(calibration, mount)
    if curve is not None:
        layers.append(Line(x=curve[0], y=curve[1], colour=PALE))
    layers.append(
        Marks(
            x=observations.angle_deg[at],
            y=observations.output_v[at],
            colour=COLOURS[index % len(COLOURS)],
            shape=SHAPES[index % len(SHAPES)],
            opacity=0.8,
        )
    )
    return Panel(
        layers=tuple(layers),
        title=Message.counted(
            "{mount} ({count} dwell)",
            "{mount} ({count} dwells)",
            mount=with_wording(mount),
            count=int(np.count_nonzero(at)),
        ),
        x=Axis(label=Message("head angle as reported (°)")),
        y=Axis(label=Message("output (V)") if first else ""),
    )


def model_curve(calibration: Calibration, mount: str) -> tuple[FloatArray, FloatArray] | None:
    """Head angles (deg) and model output (V) over the range of a mount.

    None where the parameters that have values do not give the fit back: then combinations were fitted that no single
    parameter states.
    """
    theta = np.array([calibration.parameters[name].value or 0.0 for name in PARAMETERS])
    observations = calibration.observations
    fitted = observations.output_v - calibration.residual_v
    if np.max(np.abs(basis(observations) @ coefficients(theta) - fitted)) > 1e-6 * max(np.ptp(fitted), 1e-9):
        return None
    angles = observations.angle_deg[observations.mounts == mount]
    grid = np.linspace(angles.min(), angles.max(), 361)
    shown = Observations(row=np.arange(len(grid)), angle_deg=grid, mount=np.full(len(grid), mount))
    return grid, np.asarray(basis(shown) @ coefficients(theta))


def closure_figure(closure: FlipClosure) -> Figure:
    """u0 of every flip about their mean, with one and two standard uncertainties, and what the joint fit expects."""
    names = list(closure.axes)
    places = np.arange(float(len(names)))
    panel = Panel(
        layers=tuple(_flips(closure, places)),
        x=Axis(label=Message("u0 of the flip - mean of the flips (µV)")),
        y=Axis(
            ticks=places.tolist(),
            names=[Message("{axis} flip", axis=name) for name in names],
            ends=(len(names) - 0.5, -0.5),
        ),
    )
    return Figure(
        name="closure",
        description=Message("u0 from each flip with its uncertainty, and what the joint fit expects"),
        panels=(panel,),
        height=50.0 + 34.0 * len(names),
        width=560.0,
    )


def _flips(closure: FlipClosure, places: FloatArray) -> Iterator[Layer]:
    means = list(closure.axes.values())
    u0_v = np.array([mean.u0_v for mean in means])
    centre_v = float(u0_v.mean())
    offset = (u0_v - centre_v) * MICRO
    spread = np.array([mean.standard_uncertainty_v for mean in means]) * MICRO
    expected = (np.array([mean.expected_v for mean in means]) - centre_v) * MICRO
    yield Marks(x=offset, y=places, x_ends=(offset - 2 * spread, offset + 2 * spread), size=0.0, bar=0.9)
    yield Marks(x=offset, y=places, x_ends=(offset - spread, offset + spread), size=6.0, bar=3.2, label=Message("flip"))
    yield Marks(
        x=expected, y=places, colour=COLOURS[1], shape="diamond", size=5.0, hollow=True, label=Message("joint fit")
    )
