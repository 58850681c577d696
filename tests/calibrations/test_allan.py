"""The Allan deviation of a long still recording, against what is known of noise in closed form."""

import json

import numpy as np
import pytest

from tumble.calibrations.allan.averaging import NEAR, best_time, enough_s
from tumble.calibrations.allan.coefficients import noise_model
from tumble.calibrations.allan.deviations import dense, deviation_at, deviations, doubling
from tumble.calibrations.allan.recording import StillRecording, read_still
from tumble.calibrations.allan.result import allan
from tumble.calibrations.allan.sections import sections
from tumble.calibrations.allan.spectrum import lines
from tumble.calibrations.core.cells import TableError

SAMPLES = 4096
"""A second apart."""


def white(seed, samples=SAMPLES):
    return np.random.default_rng(seed).standard_normal(samples)


def walk(seed, samples=SAMPLES):
    return np.cumsum(white(seed, samples))


def flicker(seed, samples=SAMPLES):
    """B = 1, from its spectrum B²/(2πf), made eight times as long."""
    frequency_hz = np.fft.rfftfreq(8 * samples)
    power = np.concatenate([[0.0], 1.0 / (2.0 * np.pi * frequency_hz[1:])])
    random = np.random.default_rng(seed)
    real, imaginary = random.standard_normal((2, len(power)))
    return np.fft.irfft((real + 1j * imaginary) * np.sqrt(4.0 * samples * power))[:samples]


def model_of(values):
    return noise_model(deviations(values, 1.0), len(values), 1.0)


def test_the_deviation_is_that_of_the_definition():
    values = white(1, 512)
    means = np.convolve(values, np.ones(8) / 8.0, "valid")

    (found,) = [each for each in deviations(values, 1.0) if each.tau_s == 8.0]

    assert found.value == pytest.approx(np.sqrt(0.5 * np.mean((means[8:] - means[:-8]) ** 2)), rel=1e-12)


def test_the_mean_of_the_outputs_does_not_matter():
    assert deviations(white(1) + 9.8e6, 1.0)[3].value == pytest.approx(deviations(white(1), 1.0)[3].value, rel=1e-6)


def test_the_last_time_is_a_quarter_of_the_recording():
    assert doubling(4096) == [1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024]


def test_at_long_times_an_interval_is_as_wide_as_its_few_degrees_of_freedom():
    last = deviations(white(1), 1.0)[-1]

    assert last.degrees_of_freedom < 6.0
    assert last.high / last.low > 2.5


def test_intervals_hold_as_often_as_they_say():
    held = [each.low <= each.tau_s**-0.5 <= each.high for seed in range(60) for each in deviations(white(seed), 1.0)]

    assert np.mean(held) == pytest.approx(0.95, abs=0.03)


@pytest.mark.parametrize(
    ("values", "kind"), [(white(3), "white noise"), (flicker(3), "flicker"), (walk(3), "random walk")]
)
def test_the_kind_of_noise_is_told_at_each_time(values, kind):
    assert {each.noise for each in deviations(values, 1.0)[3:7]} == {kind}


@pytest.mark.parametrize("make", [white, flicker, walk])
def test_the_scatter_of_the_estimates_is_that_of_the_spectrum(make):
    averages = [2, 16, 128, 512]
    spectrum = lines(SAMPLES, 1.0, averages)
    frequency_hz = spectrum.frequency_hz
    power = {
        white: np.ones_like(frequency_hz),
        flicker: 1.0 / (2.0 * np.pi * frequency_hz),
        walk: 1.0 / (2.0 * np.sin(np.pi * frequency_hz)) ** 2,
    }[make]

    found = np.array([deviation_at(make(seed), 1.0, averages)[1] ** 2 for seed in range(150)])

    assert found.std(axis=0) == pytest.approx(np.sqrt(np.diag(spectrum.covariance(power))), rel=0.25)


def test_coefficients_come_back_within_their_uncertainties():
    found = [model_of(white(seed) + 0.2 * flicker(seed + 500)).coefficients for seed in range(12)]

    for term, truth in ((0, 1.0), (1, 0.2)):
        told = [each[term] for each in found]
        assert np.mean([each.value for each in told]) == pytest.approx(truth, rel=0.1)
        assert np.mean([abs(each.value - truth) < 2.0 * each.standard_uncertainty for each in told]) >= 0.85


def test_what_is_not_there_is_withheld_with_a_limit():
    _, flat, wander = model_of(white(4)).coefficients

    assert (flat.value, wander.value) == (None, None)
    assert 0.0 < flat.at_most < 0.2
    assert 0.0 < wander.at_most < 0.02


def test_what_is_withheld_is_below_its_limit():
    found = [model_of(white(seed) + 0.01 * walk(seed + 500)).coefficients[2] for seed in range(12)]

    assert np.mean([each.value is not None or each.at_most > 0.01 for each in found]) >= 0.85


def test_a_trend_is_none_of_the_three_kinds_of_noise():
    trend = StillRecording(outputs={"u_x_V": white(5) + np.linspace(0.0, 30.0, SAMPLES)}, rate_hz=1.0, source="a.csv")

    assert "do not describe u_x_V" in allan(trend).warnings[0]


def test_the_place_of_a_minimum_is_soft():
    """The same sensor, recorded again and again for 68 minutes."""
    averages = dense(SAMPLES)
    minima_s = [
        averages[np.argmin(deviation_at(white(seed) + 0.5 * flicker(seed + 900), 1.0, averages)[1])]
        for seed in range(60)
    ]

    low_s, high_s = np.quantile(minima_s, [0.05, 0.95])
    assert low_s < 100.0
    assert high_s == averages[-1]


def test_the_interval_of_a_minimum_holds_those_of_other_recordings():
    first = white(20) + 0.2 * flicker(921)
    best = best_time(first, 1.0, model_of(first))

    averages = dense(SAMPLES)
    others_s = [
        averages[np.argmin(deviation_at(white(seed) + 0.2 * flicker(seed + 900), 1.0, averages)[1])]
        for seed in range(30)
    ]

    assert np.mean([best.low_s <= each <= best.high_s for each in others_s]) >= 0.8


def test_the_published_163_s_are_the_mean_of_three_minima():
    """Dzuev 2018: an Allan minimum at 150, 83 and 256 s."""
    assert round(np.mean([150, 83, 256])) == 163


def test_white_noise_alone_asks_for_no_dwell():
    assert enough_s([model_of(white(4))], 1024.0) is None


def test_a_dwell_ends_where_averaging_gains_no_more():
    model = model_of(white(6) + 0.3 * flicker(6))

    found_s = enough_s([model], 1024.0)

    half, found = model.deviation(np.array([found_s / 2.0, found_s]))
    least = model.deviation(np.geomspace(1.0, 1024.0, 400)).min()
    assert found <= NEAR * least < half


def still_csv(path, lines_):
    path.write_text("time_s,u_x_V,temperature_degC\n" + "\n".join(lines_) + "\n", "utf-8")
    return path


def test_temperatures_and_times_are_no_outputs(tmp_path):
    rows = [f"{second / 10},{value:.6f},23.0" for second, value in enumerate(white(1, 300))]

    recording = read_still(still_csv(tmp_path / "a.csv", rows))

    assert list(recording.outputs) == ["u_x_V"]
    assert recording.rate_hz == pytest.approx(10.0)


def test_of_a_recording_with_gaps_the_longest_stretch_is_used(tmp_path):
    values = white(1, 700)
    rows = [f"{second},{value:.6f},23" for second, value in enumerate(values) if second not in (300, 301)]

    recording = read_still(still_csv(tmp_path / "a.csv", rows))

    assert recording.samples == 398
    assert recording.outputs["u_x_V"][0] == pytest.approx(values[302], abs=1e-6)
    assert "gaps" in recording.warnings[0]


def test_a_value_that_is_missing_is_a_gap(tmp_path):
    rows = [f"{second},{'nan' if second == 400 else f'{value:.6f}'},23" for second, value in enumerate(white(1, 700))]

    assert read_still(still_csv(tmp_path / "a.csv", rows)).samples == 400


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        (["0,1,23", "1,2,23", "1,3,23"], "line 4: time_s does not ascend"),
        ([f"{second},{second % 7},23" for second in range(200)], "200 samples without a gap; 256 are the fewest"),
        ([f"{second},1.5,23" for second in range(300)], "column u_x_V: never changes"),
    ],
)
def test_a_recording_that_tells_nothing_is_refused(tmp_path, rows, said):
    with pytest.raises(TableError, match=said):
        read_still(still_csv(tmp_path / "a.csv", rows))


def test_without_times_the_rate_is_asked_for(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("u_x_V\n" + "\n".join(f"{value:.6f}" for value in white(1, 300)) + "\n", "utf-8")

    with pytest.raises(TableError, match="give the rate"):
        read_still(path)
    assert read_still(path, 50.0).duration_s == pytest.approx(6.0)


@pytest.fixture(scope="module")
def two_outputs():
    outputs = {"u_x_V": white(1) + 0.3 * flicker(2), "u_y_V": white(3)}
    return allan(StillRecording(outputs=outputs, rate_hz=1.0, source="still.csv"))


def test_the_document_is_json_with_units(two_outputs):
    document = json.loads(json.dumps(two_outputs.document()))

    assert document["schema"] == "tumble.allan/1"
    assert document["outputs"]["u_x_V"]["coefficients"]["N"]["unit"] == "V·√s"
    assert document["outputs"]["u_y_V"]["coefficients"]["B"]["value"] is None


def test_an_open_end_of_the_interval_is_said(two_outputs):
    assert two_outputs.document()["outputs"]["u_y_V"]["best"]["interval_s"][1] is None
    assert "longer recording" in next(sections(two_outputs)).rows[1][3]


def test_the_curve_is_drawn(two_outputs):
    (drawn,) = [each.figure().__html__() for each in sections(two_outputs) if each.figure]

    assert drawn.startswith("<svg")
