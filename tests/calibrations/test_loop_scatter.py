"""What scatters or wanders beyond the samples of a dwell is a warning with its size, and no effect."""

import re
from dataclasses import replace

import numpy as np
import pytest
from tables import FLIPS, sweep, table

from tumble.calibrations.methods.dividing_head.loop.loop import close_loop

PARTS = (*FLIPS, sweep("face-up"), sweep("face-down"))


def sampled(rows, dwell_sd_v=1e-4, samples=100):
    """The same with 100 samples in each dwell, whose mean would scatter by `dwell_sd_v` if they were independent."""
    count = len(rows)
    return replace(
        rows,
        voltage_sd_v=np.full(count, dwell_sd_v * np.sqrt(samples)),
        samples=np.full(count, samples),
        time_s=6.0 * np.arange(count),
    )


def flickering(rows, first_mode_v):
    """Noise whose power falls as 1/f: cosines over the run with variances as 1/k."""
    part, order = np.linspace(0.0, 1.0, len(rows)), np.arange(1, 400)
    drawn = np.random.default_rng(11).normal(size=len(order)) / np.sqrt(order)
    wave_v = first_mode_v * np.sqrt(2.0) * np.cos(np.pi * np.outer(part, order)) @ drawn
    return replace(rows, voltage_v=rows.voltage_v + wave_v)


def said(rows):
    loop = close_loop(rows)
    assert loop.effects == ()
    assert loop.unexplained is None
    return [warning for warning in loop.augmented.warnings if "scatter" in warning or "wanders" in warning]


def test_scatter_that_the_samples_explain_is_not_told():
    assert said(sampled(table(*PARTS))) == []


@pytest.mark.parametrize("noise_v", [1.6e-4, 3e-4])
def test_more_scatter_between_repeats_than_that_of_samples_is_told_with_both_sizes(noise_v):
    (warning,) = said(sampled(table(*PARTS, noise_v=noise_v)))

    assert "the samples of a dwell explain 100 µV" in warning
    assert float(re.search(r"repeats scatter by (\d+) µV", warning)[1]) == pytest.approx(1e6 * noise_v, rel=0.05)


def test_without_a_scatter_of_the_samples_nothing_is_said_of_it():
    assert said(table(*PARTS, noise_v=3e-4)) == []


def test_flicker_is_told_with_its_floor():
    (warning,) = said(flickering(sampled(table(*PARTS), dwell_sd_v=1.5e-4), 3e-5))

    assert "the bias wanders (" in warning
    assert "flicker" in warning


def test_a_drift_too_small_for_a_name_may_be_what_wanders():
    rows = sampled(table(*PARTS, realisations=5, seed=5))
    drift_v = 5.5e-5 * np.linspace(-0.5, 0.5, len(rows))
    (warning,) = said(replace(rows, voltage_v=rows.voltage_v + drift_v))

    assert "the bias wanders (drift, walk or flicker)" in warning
