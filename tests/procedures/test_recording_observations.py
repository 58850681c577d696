import numpy as np
import pytest
from recording_examples import FINISHED, completed, record, run_of

from tumble.calibrations.core.rows import SetAside
from tumble.procedures.events import FinishReason, RunFinished, WarningRaised
from tumble.procedures.methods.dividing_head.observations import observations
from tumble.procedures.recording.reader import read_recording


def reduce(tmp_path, events):
    return observations(read_recording(record(tmp_path / "run.mcap", events)))


def test_a_point_becomes_a_row(tmp_path):
    table = reduce(tmp_path, [completed(0), completed(1, angle_deg=-90.0, mount="edge", direction=1), FINISHED])

    assert table.row.tolist() == [1, 2]
    assert table.angle_deg.tolist() == [395.0, -90.0]
    assert table.voltage_v.tolist() == [2.5001234567890123] * 2
    assert table.voltage_sd_v.tolist() == [1.1e-3] * 2
    assert table.samples.tolist() == [3, 3]
    assert table.time_s.tolist() == [12.5, 12.5]
    assert table.realisation.tolist() == [1, 1]
    assert table.procedure.tolist() == ["sweep", "sweep"]
    assert table.mount.tolist() == ["face-up", "edge"]
    assert table.direction.tolist() == [-1, 1]
    assert table.temperature_degc.tolist() == [23.25, 23.25]
    assert table.source == str(tmp_path / "run.mcap")
    assert table.complete
    assert table.warnings == ()


def test_a_single_missing_temperature_is_nan(tmp_path):
    table = reduce(tmp_path, [completed(0), completed(1, temperature_degc=None), FINISHED])

    np.testing.assert_array_equal(table.temperature_degc, [23.25, np.nan])


def test_without_any_temperature_there_is_no_such_column(tmp_path):
    assert reduce(tmp_path, [completed(0, temperature_degc=None), FINISHED]).temperature_degc is None


def test_rows_without_a_measurement_are_set_aside(tmp_path):
    voltages = [2.5, np.nan, -np.inf, 9.9e37, 2.6]
    table = reduce(tmp_path, [*(completed(k, voltage_v=v) for k, v in enumerate(voltages)), FINISHED])

    assert table.voltage_v.tolist() == [2.5, 2.6]
    assert table.row.tolist() == [1, 5]
    assert [entry.row for entry in table.set_aside] == [2, 3, 4]
    assert table.set_aside[2] == SetAside(row=4, reason="overload: voltage_v is 9.9e+37")
    assert table.rows_read == 5


def test_a_cut_recording_is_not_complete_and_says_so(tmp_path):
    path = record(tmp_path / "run.mcap", run_of(3))
    with path.open("r+b") as stream:
        stream.truncate(path.stat().st_size - 1)

    table = observations(read_recording(path))

    assert not table.complete
    assert len(table) == 3
    assert table.warnings == (
        "the certificate of the DAQ has expired",
        f"{path} was cut off or damaged; its 3 complete points are used",
    )


@pytest.mark.parametrize(
    ("events", "warning"),
    [
        (
            [RunFinished(reason=FinishReason.STOPPED, message="stopped", at_standstill=True)],
            "holds a run that ended early (stopped by the operator); its 1 complete point is used",
        ),
        ([], "holds no end of the run; its 1 complete point is used"),
    ],
)
def test_a_run_that_ended_early_is_not_complete_and_says_so(tmp_path, events, warning):
    table = reduce(tmp_path, [completed(0), *events])

    assert not table.complete
    assert table.warnings == (f"{tmp_path / 'run.mcap'} {warning}",)


def test_warnings_of_the_run_reach_the_table(tmp_path):
    table = reduce(tmp_path, [WarningRaised(message="point 0 was still moving"), completed(0), FINISHED])

    assert table.warnings == ("point 0 was still moving",)


def test_a_recording_without_points_is_an_empty_table(tmp_path):
    table = reduce(tmp_path, [FINISHED])

    assert len(table) == 0
    assert table.temperature_degc is None
