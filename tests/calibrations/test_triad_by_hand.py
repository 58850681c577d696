"""A triad that was held still by hand: still intervals, nine parameters, what is left."""

import numpy as np
import pytest

from tumble.calibrations.methods.triad.hand.still import still_poses
from tumble.calibrations.methods.triad.method import METHOD

STEP_S = 0.01
POSE_S, MOVE_S = 6.0, 2.0
RESPONSE = np.array([[4068.0, 0.0, 0.0], [12.0, 4046.0, 0.0], [35.0, 80.0, 4070.0]])
BIAS = np.array([33124.0, 33275.0, 32364.0])
NOISE = 3.0


def poses(count, seed=5):
    """Directions all round, shape (count, 3)."""
    a = np.random.default_rng(seed).normal(size=(count, 3))
    return a / np.linalg.norm(a, axis=1, keepdims=True)


def log(count=20, seed=5):
    """Time and outputs in counts: still in each pose, shaken between them."""
    rng = np.random.default_rng(seed)
    still, moved = int(POSE_S / STEP_S), int(MOVE_S / STEP_S)
    parts = []
    for a in poses(count, seed):
        parts += [np.repeat(a[None], still, axis=0), a + rng.normal(0.0, 0.3, (moved, 3))]
    a = np.concatenate(parts)
    return STEP_S * np.arange(len(a)), BIAS + a @ RESPONSE.T + rng.normal(0.0, NOISE, (len(a), 3))


def written(path, columns):
    lines = [",".join(columns), *(",".join(f"{v:.5f}" for v in row) for row in zip(*columns.values(), strict=True))]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def as_columns(outputs, **before):
    return before | {f"u_{c}_counts": outputs[:, place] for place, c in enumerate("xyz")}


@pytest.fixture(scope="module")
def result(tmp_path_factory):
    time_s, outputs = log()
    path = written(tmp_path_factory.mktemp("hand") / "log.csv", as_columns(outputs, time_s=time_s))
    return METHOD.close_loop([path])


def test_every_pose_is_one_still_interval_without_the_moves():
    time_s, outputs = log()
    found = still_poses(time_s, outputs)
    assert len(found) == 20
    for number, pose in enumerate(found):
        start = number * (POSE_S + MOVE_S)
        assert start <= pose.start_s < start + 1.0
        assert POSE_S - 1.5 < pose.length_s <= POSE_S


def test_the_nine_parameters_come_back_inside_three_standard_uncertainties(result):
    lower = np.linalg.cholesky(RESPONSE @ RESPONSE.T)
    norms = np.linalg.norm(lower, axis=1)
    truth = {"bias_x": BIAS[0], "bias_y": BIAS[1], "bias_z": BIAS[2], "norm_x": norms[0], "norm_z": norms[2]}
    for name, value in truth.items():
        parameter = result.parameters[name]
        assert abs(parameter.value - value) < 3 * parameter.standard_uncertainty, name


def test_parameters_carry_the_unit_of_the_log(result):
    assert result.parameters["bias_x"].unit == "counts"
    assert result.parameters["norm_x"].unit == "counts/g"


def test_where_nothing_but_noise_is_left_the_noise_explains_the_mismatch(result):
    assert result.fit.mismatch.standard_deviation_arcsec == pytest.approx(result.noise_arcsec, rel=0.5)


def test_it_says_that_a_rotation_of_the_triad_is_not_seen(result):
    assert any("a rotation of the whole triad" in line for section in result.sections() for line in section.lines)


def test_a_table_of_one_row_a_pose_is_read_without_time(tmp_path):
    outputs = BIAS + poses(18) @ RESPONSE.T
    found = METHOD.close_loop([written(tmp_path / "poses.csv", as_columns(outputs))])
    assert found.parameters["bias_y"].value == pytest.approx(BIAS[1], abs=1e-2)
    assert found.noise_arcsec is None


def test_one_pose_that_was_not_still_is_left_out(tmp_path):
    outputs = BIAS + poses(24) @ RESPONSE.T + np.random.default_rng(1).normal(0.0, 0.3, (24, 3))
    outputs[5] *= 1.01
    found = METHOD.close_loop([written(tmp_path / "poses.csv", as_columns(outputs))])
    assert found.document()["poses"] == {"found": 24, "used": 23}


def test_too_few_poses_are_refused_with_the_number_that_is_needed(tmp_path):
    outputs = BIAS + poses(8) @ RESPONSE.T
    with pytest.raises(ValueError, match=r"8 still poses are too few .* at least 12 poses"):
        METHOD.close_loop([written(tmp_path / "poses.csv", as_columns(outputs))])


def test_outputs_that_are_no_triad_are_refused(tmp_path):
    outputs = np.random.default_rng(2).uniform(0.0, 1.0, (20, 3)) ** 3
    with pytest.raises(ValueError, match=r"poses\.csv"):
        METHOD.close_loop([written(tmp_path / "poses.csv", as_columns(outputs))])
