import json
import shutil
from dataclasses import replace

import pytest
from app_jobs import tumble
from mcap.reader import make_reader

from tumble.app.analysing import fit
from tumble.app.measurements import read_measurement
from tumble.procedures.errors import InputError

TABLE = "angle_deg,voltage_V\n0,2.5\n90,1.5\n"
BAD_TABLES = {
    "no file": (None, ": cannot be read (No such file or directory); check the name and the rights"),
    "nothing in it": ("", ": the file is empty; expected a header line and one row per dwell"),
    "a header only": ("angle_deg,voltage_V\n", ": there is a header but no row; expected one row per dwell"),
    "another column": (
        TABLE.replace("voltage_V", "volts"),
        ", line 1: column voltage_V (or reference_deg) is missing; the columns are angle_deg, volts",
    ),
    "a ragged line": (
        TABLE + "180\n",
        ", line 4: 1 value where the header has 2 columns; complete the line or remove it",
    ),
    "text for a number": (
        TABLE + "180,2;5\n",
        ", line 4, column voltage_V: '2;5' is not a number; write it with a decimal point, or nan where there is none",
    ),
    "an unknown mount": (
        "angle_deg,voltage_V,mount\n0,2.5,side\n",
        ", line 2, column mount: 'side' is no mount; known are face-up, face-up-90, face-down, edge, edge-back, end",
    ),
    "no UTF-8": (TABLE.encode() + b"# \xe4\n", ", line 4: not UTF-8 (byte 0xe4); save the table as UTF-8"),
    "overloads only": (
        "angle_deg,voltage_V\n0,9.9e37\n",
        ": no usable row, 1 set aside (row 1: overload: voltage_v is 9.9e+37); correct the table, or measure again",
    ),
    "a gyrocompass at a pole": (
        "azimuth_deg,rate_deg_h,latitude_deg\n0,1,-90\n90,2,-90\n",
        ": no usable row, 2 set aside (row 1: latitude_deg is -90: so near a pole next to nothing of the earth "
        "rate is level, and there is no heading); correct the table, or measure again",
    ),
    "no output": (
        "angle_deg,reference_deg\n0,0.1\n",
        ": there is no column voltage_V; a calibration needs the unit's output",
    ),
}
NOT_A_RECORDING = (
    ": is not a recording, or was cut off before its header was complete; nothing can be recovered from it"
)


@pytest.mark.parametrize("command", ["fit", "report"])
@pytest.mark.parametrize(("content", "complaint"), BAD_TABLES.values(), ids=BAD_TABLES)
def test_a_bad_table_is_named_with_line_column_and_remedy(write, tmp_path, command, content, complaint):
    table = tmp_path / "bad.csv" if content is None else write("bad.csv", content)

    ran = tumble(command, table)

    assert ran.status == 2
    assert ran.complaint == f"{table}{complaint}"
    assert ran.out == ""


@pytest.mark.parametrize("command", ["fit", "export", "report"])
@pytest.mark.parametrize("content", [b"", b"nothing of the kind" * 40], ids=["empty", "garbage"])
def test_what_is_no_recording_is_told_so(write, command, content):
    recording = write("x.mcap", content)

    ran = tumble(command, recording)

    assert ran.status == 2
    assert ran.complaint == f"{recording}{NOT_A_RECORDING}"


@pytest.mark.parametrize("command", ["fit", "export", "report"])
def test_a_recording_that_is_not_there_is_named(tmp_path, command):
    ran = tumble(command, tmp_path / "none.mcap")

    assert ran.status == 2
    assert ran.complaint == f"{tmp_path / 'none.mcap'}: cannot be read (No such file or directory); check the name"


def ends_of_points(recording):
    """Where the chunk of each point ends."""
    with recording.open("rb") as stream:
        summary = make_reader(stream).get_summary()
    channel = next(number for number, channel in summary.channels.items() if channel.topic == "/point")
    chunks = [chunk for chunk in summary.chunk_indexes if channel in chunk.message_index_offsets]
    return [chunk.chunk_start_offset + chunk.chunk_length for chunk in chunks]


@pytest.fixture
def cut(tiny_recording, tmp_path):
    """The recording of six points, cut one byte before the end of the point of that number."""

    def cut_at(point):
        path = tmp_path / "cut.mcap"
        path.write_bytes(tiny_recording.read_bytes()[: ends_of_points(tiny_recording)[point - 1] - 1])
        return path

    return cut_at


def test_a_recording_cut_before_its_first_point_is_bad_input(cut):
    recording = cut(1)

    ran = tumble("fit", recording)

    assert ran.status == 2
    assert ran.complaint == f"{recording}: no usable row; measure again"


def test_a_cut_recording_is_fitted_with_a_warning_and_marked_incomplete(cut, tmp_path):
    recording = cut(6)

    ran = tumble("fit", recording, "--store", tmp_path / "s", "--json", "-")

    document = json.loads(ran.out)
    record = json.loads(tumble("records", "export", document["record"], "--store", tmp_path / "s").out)
    assert ran.status == 0
    assert f"warning: {recording} was cut off or damaged; its 5 complete points are used\n" in ran.err
    assert document["rows"]["used"] == 5
    assert document["complete"] is False
    assert record["result"]["complete"] is False


def test_a_cut_recording_exports_its_complete_points(cut, tmp_path):
    ran = tumble("export", cut(4), "--out", tmp_path / "x.csv")

    assert ran.status == 0
    assert len((tmp_path / "x.csv").read_text().splitlines()) == 1 + 3
    assert "was cut off or damaged" in ran.err


def test_a_record_of_a_cut_recording_is_verified(cut, tmp_path):
    tumble("fit", cut(6), "--store", tmp_path / "s")

    assert tumble("records", "verify", "--store", tmp_path / "s").status == 0


def test_a_recorded_stand_file_that_does_not_fit_is_told_so_with_the_way_round(tiny_recording):
    measurement = replace(read_measurement(tiny_recording), stand={"name": "bench-1", "daq": {"driver": "simulated"}})

    with pytest.raises(InputError) as raised:
        fit(measurement)

    complaint = "the stand file in it does not fit: head: Field required; give one with --stand"
    assert str(raised.value) == f"{tiny_recording}: {complaint}"


def test_rows_that_cannot_be_used_are_listed_and_the_rest_is_used(write):
    good = "0,2.5\n30,2\n60,1.634\n90,1.5\n120,1.634\n150,2\n180,2.5\n210,3\n240,3.366\n270,3.5\n300,3.366\n330,3\n"
    table = write("t.csv", f"angle_deg,voltage_V\n{good}0,nan\n{good}90,9.9e37\n")

    document = json.loads(tumble("fit", table, "--json", "-").out)

    assert document["rows"]["used"] == 24
    assert [aside["row"] for aside in document["rows"]["set_aside"]] == [13, 26]


@pytest.mark.parametrize(
    "arguments",
    [
        ("export", "x.mcap", "--out", "x.mcap"),
        ("fit", "x.mcap", "--json", "x.MCAP"),
        ("report", "x.mcap", "--out", "x.mcap"),
    ],
    ids=lambda arguments: arguments[0],
)
def test_nothing_is_written_over_a_recording(tiny_recording, tmp_path, monkeypatch, no_report, arguments):
    monkeypatch.chdir(tmp_path)
    shutil.copy(tiny_recording, "x.mcap")

    ran = tumble(*arguments)

    assert ran.status == 2
    assert ran.complaint.endswith(": has the name of a recording, and those are never overwritten; choose another name")
    assert (tmp_path / "x.mcap").read_bytes() == tiny_recording.read_bytes()


def test_a_table_is_not_exported_over_itself(write):
    table = write("t.csv", TABLE + "180,nan\n")

    ran = tumble("export", table)

    assert ran.status == 2
    assert ran.complaint == f"{table}: is no recording; name a file that ends in .mcap"
    assert table.read_text() == TABLE + "180,nan\n"


def test_a_run_is_not_recorded_under_a_name_that_no_command_would_read(tiny, tmp_path):
    ran = tumble("run", "--programme", tiny, "--serial", "A", "--out", tmp_path / "x")

    assert ran.status == 2
    assert ran.complaint == f"{tmp_path / 'x'}: is no name of a recording; end it in .mcap"
    assert not (tmp_path / "x").exists()


def test_a_run_never_replaces_a_recording(tiny, tiny_recording, tmp_path):
    recording = shutil.copy(tiny_recording, tmp_path / "x.mcap")

    ran = tumble("run", "--programme", tiny, "--serial", "A", "--out", recording)

    assert ran.status != 0
    assert ran.complaint == f"{recording}: exists already; recordings are not overwritten: choose another name"
    assert recording.read_bytes() == tiny_recording.read_bytes()
