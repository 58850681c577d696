"""Plots of the fit itself and of the flips."""

import numpy as np
from markupsafe import Markup

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.flips import FlipClosure
from tumble.calibrations.methods.dividing_head.model import PARAMETERS, basis, coefficients
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.report.subject import mounts_of
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.report.drawing import COLOURS, HALF_IN, MICRO, PALE, WIDE_IN, cloud, sheet, styled, to_svg
from tumble.messages import Message, with_wording


@styled
def fit_figure(calibration: Calibration) -> Markup:
    """Output against head angle, one panel a mount, with the model where its parameters draw it."""
    observations = calibration.observations
    mounts = mounts_of(observations)
    columns = min(len(mounts), 2)
    rows = -(-len(mounts) // columns)
    figure, axes = sheet(WIDE_IN, 0.5 + 2.4 * rows, rows, columns)
    for unused in axes[len(mounts) :]:
        unused.remove()
    for index, (panel, mount) in enumerate(zip(axes, mounts, strict=False)):
        at = observations.mounts == mount
        cloud(panel, observations.angle_deg[at], observations.output_v[at], index, strong=True)
        curve = model_curve(calibration, mount)
        if curve is not None:
            panel.plot(*curve, color=PALE, linewidth=1.1, zorder=1.5)
        panel.set_title(Message("{mount} ({dwells} dwells)", mount=with_wording(mount), dwells=np.count_nonzero(at)))
        panel.set_xlabel(Message("head angle as reported (°)"))
        panel.xaxis.set_tick_params(labelbottom=True)
    for panel in axes[: len(mounts) : columns]:
        panel.set_ylabel(Message("output (V)"))
    return to_svg(
        figure,
        "fit",
        Message(
            "Output against head angle with the fitted model, for {mounts}",
            mounts=Message.joined(", ", map(with_wording, mounts)),
        ),
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


@styled
def closure_figure(closure: FlipClosure) -> Markup:
    """u0 of every flip about their mean, with one and two standard uncertainties, and what the joint fit expects."""
    names = list(closure.axes)
    means = [closure.axes[name] for name in names]
    centre_v = float(np.mean([mean.u0_v for mean in means]))
    figure, (panel,) = sheet(HALF_IN + 1.5, 0.75 + 0.42 * len(names))
    for place, mean in enumerate(means):
        offset, spread = (mean.u0_v - centre_v) * MICRO, mean.standard_uncertainty_v * MICRO
        panel.errorbar(offset, place, xerr=2 * spread, color=COLOURS[0], linewidth=0.9)
        panel.errorbar(offset, place, xerr=spread, color=COLOURS[0], linewidth=3.2)
        panel.plot(offset, place, "o", color=COLOURS[0], markersize=6, label=Message("flip") if not place else None)
        panel.plot((mean.expected_v - centre_v) * MICRO, place, "D", color=COLOURS[1], markersize=5,
                   markerfacecolor="white", label=Message("joint fit") if not place else None)  # fmt: skip
    panel.set_yticks(range(len(names)), [Message("{axis} flip", axis=name) for name in names])
    panel.set_ylim(len(names) - 0.5, -0.5)
    panel.set_xlabel(Message("u0 of the flip - mean of the flips (µV)"))
    panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return to_svg(figure, "closure", Message("u0 from each flip with its uncertainty, and what the joint fit expects"))
