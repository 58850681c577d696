"""Samples of dwells reduced: at the bound where the plain mean errs by milligrams, or refused by name."""

from dataclasses import replace

import numpy as np
import pytest

from tumble.calibrations.core.cells import TableError
from tumble.calibrations.methods.vibration.dwells.long_run import widening
from tumble.calibrations.methods.vibration.dwells.reduction import reduced
from tumble.calibrations.methods.vibration.dwells.rows import rows_of
from tumble.calibrations.methods.vibration.dwells.samples import SampledDwells, Samples, read_samples
from tumble.calibrations.methods.vibration.loop import declared_fit
from tumble.calibrations.methods.vibration.products import mean_products

RATE_HZ, COUNT = 1000.0, 4000
K_UG_G2, REST_UG, NOISE_G = 50.0, 400.0, 4e-4
BOUND_UG = NOISE_G * 1e6 * np.sqrt(1.5 / COUNT)
"""Of a rectification against two rests of the same length: 7.7 µg."""


def sine(frequency_hz, amplitude_g=7.0, second=0.0, count=COUNT):
    phase = 2.0 * np.pi * frequency_hz * np.arange(count) / RATE_HZ + 0.3
    return amplitude_g * (np.sin(phase) + second * np.sin(2.0 * phase + 0.8))


def dwell(number, motion, drive_hz=0.0, kind=None, seed=1, kept=slice(None), noise_g=NOISE_G, limit_g=np.inf):
    rng = np.random.default_rng([seed, number])
    output = REST_UG * 1e-6 + np.minimum(motion, limit_g) + K_UG_G2 * 1e-6 * motion**2
    return Samples(
        dwell=number,
        kind=kind or ("vibration" if motion.any() else "rest"),
        drive_hz=drive_hz,
        time_s=(10.0 * number + np.arange(len(motion)) / RATE_HZ)[kept],
        output_g=(output + rng.normal(0.0, noise_g, len(motion)))[kept],
        references_g=(
            (motion + rng.normal(0.0, 1e-4, len(motion)))[kept],
            (0.02 * motion + rng.normal(0.0, 1e-4, len(motion)))[kept],
        ),
    )


def three(motion, drive_hz, **more):
    still = np.zeros(COUNT)
    return SampledDwells(dwells=(dwell(1, still), dwell(2, motion, drive_hz, **more), dwell(3, still)))


@pytest.mark.parametrize(
    ("nominal_hz", "frequency_hz"), [(38.7, 38.9), (0.8, 0.8182), (160.0, 160.9), (80.0, 80.0), (3.0, 3.14)]
)
def test_a_drive_off_its_nominal_frequency_is_reduced_at_the_bound(nominal_hz, frequency_hz):
    found = reduced(three(sine(frequency_hz), nominal_hz))
    assert found.rectification.value_ug == pytest.approx(K_UG_G2 * 24.5, abs=3.0 * BOUND_UG)
    assert found.rectification.standard_uncertainty_ug == pytest.approx(BOUND_UG, rel=0.25)
    moved = found.dwells[1]
    assert moved.frequency_hz == pytest.approx(frequency_hz, rel=1e-5)
    assert moved.amplitude_g == pytest.approx(7.0, rel=1e-4)
    assert (moved.products.ii_g2, moved.products.io_g2) == pytest.approx((24.5, 0.49), rel=1e-3)


def test_missing_samples_do_no_harm():
    kept = np.random.default_rng(2).random(COUNT) > 0.2
    found = reduced(three(sine(38.9), 38.7, kept=kept)).rectification
    assert found.value_ug == pytest.approx(K_UG_G2 * 24.5, abs=25.0)


def test_a_harmonic_of_the_drive_counts_in_the_mean_square():
    moved = reduced(three(sine(38.9, second=0.1), 38.9)).dwells[1]
    assert moved.products.ii_g2 == pytest.approx(24.5 * 1.01, rel=1e-4)
    assert moved.amplitude_g == pytest.approx(7.0, rel=1e-4)


def test_the_phase_is_that_at_the_start_of_the_dwell():
    assert reduced(three(sine(38.9), 38.9)).dwells[1].phase_i_deg == pytest.approx(np.rad2deg(0.3), abs=0.05)


@pytest.mark.parametrize(("ratio", "power"), [(2.0, 2), (3.0, 3), (4.0, 4)])
def test_a_drive_locked_to_the_clock_is_refused(ratio, power):
    found = reduced(three(sine(RATE_HZ / ratio), RATE_HZ / ratio))
    assert found.rectification.value_ug is None
    assert (
        f"too few phases: {ratio:g} samples a period, locked to the clock, falsify the mean of the power {power}"
        in (found.warnings[0])
    )
    assert found.document()["dwells"][1]["mean_ug"] is None


def test_five_phases_are_enough():
    assert reduced(three(sine(200.0), 200.0)).rectification.value_ug is not None


@pytest.mark.parametrize("limit_g", [6.97, 6.5, 4.0])
def test_a_clipped_output_is_refused(limit_g):
    found = reduced(three(sine(38.9), 38.9, limit_g=limit_g))
    assert found.rectification.value_ug is None
    assert "clipping: the wave of output_g is cut at its peak" in found.warnings[0]


def test_an_output_that_never_changes_is_refused():
    still = [replace(each, output_g=np.full(COUNT, 0.25)) for each in three(sine(38.9), 38.9).dwells]
    found = reduced(SampledDwells(dwells=tuple(still)))
    assert found.rectification.value_ug is None
    assert [each.mean.value_ug for each in found.dwells] == [None, None, None]
    assert "dwell 1: output_g never changes" in found.warnings[0]


def test_a_reference_that_never_changes_under_vibration_is_refused():
    before, moved, after = three(sine(38.9), 38.9).dwells
    moved = replace(moved, references_g=(np.zeros(COUNT), np.zeros(COUNT)))
    found = reduced(SampledDwells(dwells=(before, moved, after)))
    assert found.rectification.value_ug is None
    assert "dwell 2: reference_i_g never changes" in found.warnings[0]


@pytest.mark.parametrize("times", [1.5, 0.667, 2.0, 0.5])
def test_a_drive_that_is_wrongly_stated_is_refused(times):
    found = reduced(three(sine(38.9), 38.9 * times))
    assert found.rectification.value_ug is None
    assert "drive_Hz is wrong: the vibration is at 39 Hz" in found.warnings[0]


def test_a_drive_beside_stronger_random_vibration_is_no_wrong_one():
    motion = sine(38.9, amplitude_g=2.0) + np.random.default_rng(6).normal(0.0, 3.0, COUNT)
    assert reduced(three(motion, 38.9)).warnings == ()


def test_an_output_in_another_unit_than_the_reference_is_asked_about():
    milli = [replace(each, output_g=1e3 * each.output_g) for each in three(sine(38.9), 38.9).dwells]
    (asked,) = reduced(SampledDwells(dwells=tuple(milli))).warnings
    assert asked.startswith("dwell 2: output_g vibrates 1000 times as much as reference_i_g; is it in g")


@pytest.mark.parametrize("second", [0.0, 0.05, -0.05])
def test_distortion_is_no_clipping(second):
    assert reduced(three(sine(38.9, second=second), 38.9)).warnings == ()


def test_random_vibration_gives_its_mean_square_and_rectification():
    motion = 2.0 * np.diff(np.random.default_rng(4).normal(0.0, 1.0, COUNT + 1)) / np.sqrt(2.0)
    found = reduced(three(motion, 0.0, kind="random"))
    square = float(np.mean(motion**2))
    moved = found.dwells[1]
    assert moved.products.ii_g2 == pytest.approx(square, rel=2e-3)
    assert moved.products.io_g2 == pytest.approx(0.02 * square, rel=5e-3)
    assert moved.products.ii_uncertainty_g2 == pytest.approx(
        square * np.sqrt(3.0 / COUNT), rel=0.15
    )  # ∫G² is 3/2 of white
    assert found.rectification.value_ug == pytest.approx(K_UG_G2 * square, abs=4.0 * BOUND_UG)


def test_autocorrelated_noise_widens_the_uncertainty_of_a_mean():
    """Of a first-order autoregression with 0.8 the mean is known three times worse."""
    noise = np.random.default_rng(5).normal(0.0, 1.0, 20_000)
    coloured = np.zeros(len(noise))
    for place in range(1, len(noise)):
        coloured[place] = 0.8 * coloured[place - 1] + noise[place]
    assert widening(noise) == 1.0
    assert widening(coloured) == pytest.approx(3.0, rel=0.15)


def test_a_drift_between_the_rests_is_in_the_uncertainty():
    still, moved = np.zeros(COUNT), sine(38.9)
    drifted = dwell(3, still)
    drifted = Samples(**{**vars(drifted), "output_g": drifted.output_g + 300e-6})
    found = reduced(SampledDwells(dwells=(dwell(1, still), dwell(2, moved, 38.9), drifted))).rectification
    assert found.value_ug == pytest.approx(K_UG_G2 * 24.5 - 150.0, abs=30.0)
    assert found.standard_uncertainty_ug == pytest.approx(300.0 / np.sqrt(12.0), rel=0.1)


def test_a_single_rest_does_not_show_a_drift():
    found = reduced(SampledDwells(dwells=(dwell(1, np.zeros(COUNT)), dwell(2, sine(38.9), 38.9)), source="s.csv"))
    assert found.warnings == ("s.csv: the rests do not show a drift; rest before and after vibration",)


def test_reduced_dwells_are_rows_that_are_fitted():
    still = np.zeros(COUNT)
    moved = [sine(38.9, amplitude) for amplitude in (3.0, 5.0, 7.0, 9.0)]
    listed = [dwell(1, still)]
    for motion in moved:
        listed += [dwell(len(listed) + 1, motion, 38.9), dwell(len(listed) + 2, still)]
    rows = rows_of(reduced(SampledDwells(dwells=tuple(listed))))
    assert mean_products(rows)[3, 0] == pytest.approx(12.5, rel=1e-4)
    assert not rows.random.any()
    fitted = declared_fit(rows).model.parameters["k_ii"]
    assert fitted.value == pytest.approx(K_UG_G2, abs=4.0 * fitted.standard_uncertainty)


def test_samples_are_read_and_those_without_an_output_left_out(tmp_path):
    path = tmp_path / "s.csv"
    lines = [f"1,{n / 100},rest,0,{0.001 * (n % 3)}" for n in range(20)] + ["1,0.2,rest,0,nan"]
    path.write_text("dwell,time_s,kind,drive_Hz,output_g\n" + "\n".join(lines) + "\n", encoding="utf-8")
    sampled = read_samples(path)
    assert len(sampled.dwells[0].time_s) == 20
    assert sampled.warnings == (f"{path}: 1 sample holds no output and is left out",)


def test_times_that_do_not_ascend_are_refused(tmp_path):
    path = tmp_path / "s.csv"
    lines = [f"1,{20 - n},rest,0,0.1" for n in range(20)]
    path.write_text("dwell,time_s,kind,drive_Hz,output_g\n" + "\n".join(lines) + "\n", encoding="utf-8")
    with pytest.raises(TableError, match="the times of dwell 1 do not ascend"):
        read_samples(path)


@pytest.mark.parametrize("drive", ["-37.0", "1e9"])
def test_a_drive_that_no_sample_follows_is_refused(tmp_path, drive):
    lines = [f"1,{step / RATE_HZ},vibration,{drive},{0.1 * (-1) ** step}" for step in range(20)]
    path = tmp_path / "samples.csv"
    path.write_text("dwell,time_s,kind,drive_Hz,output_g\n" + "\n".join(lines))

    with pytest.raises(TableError, match=r"samples\.csv: drive_Hz of dwell 1 is .* the sampling rate, 1000 Hz"):
        read_samples(path)
