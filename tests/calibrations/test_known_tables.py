import pytest

from tumble.app.methods import methods
from tumble.calibrations.core.cells import TableError, holds_numbers
from tumble.calibrations.core.files import read_header
from tumble.calibrations.core.known_tables import recognised
from tumble.calibrations.methods.temperature.columns import Column, column_of, unit_of
from tumble.calibrations.methods.temperature.table import read_runs


def kind_of(path):
    return recognised(path, methods()).name


TRIAD = (
    "run,ambient_degC,sensor_degC,bias_x_arcsec,bias_y_arcsec,bias_z_arcsec,scale_x_percent,scale_y_percent,"
    "scale_z_percent,angle_1_arcsec,angle_2_arcsec,angle_3_arcsec,angle_4_arcsec,angle_5_arcsec,angle_6_arcsec"
)
"""Header of tables 4.11 to 4.14 of Dzuev 2018."""


def table(tmp_path, header, rows=8):
    width = header.count(",") + 1
    lines = [",".join([str(20 + 5 * row)] * width) for row in range(rows)]
    (tmp_path / "table.csv").write_text("\n".join([header, *lines, ""]), "utf-8")
    return tmp_path / "table.csv"


@pytest.mark.parametrize(
    ("header", "kind"),
    [
        ("angle_deg,voltage_V,temperature_degC", "dividing_head"),
        ("angle_deg,voltage_V,reference_deg", "dividing_head"),
        ("angle_deg,reference_deg,temperature_degC", "head_reference"),
        ("run,sensor_degC,bias_V", "temperature"),
        ("temperature_degC,time_h,samples,u0_V,kx_V_per_g,kxy_mV", "temperature"),
        ("sensor_degC,bias_deg_h,scale_ppm", "temperature"),
        ("time_s,apparatus,ai_g,output_ug,temperature_degC", "vibration"),
        (TRIAD, "temperature"),
        ("time_s,azimuth_deg,rate_deg_h,temperature_degC", "gyrocompass"),
    ],
)
def test_a_table_is_known_by_its_columns(tmp_path, header, kind):
    assert kind_of(table(tmp_path, header)) == kind


@pytest.mark.parametrize(
    ("header", "looks"),
    [
        ("temperature_degC,humidity_percent,time_h", "the climate of a room (humidity_percent)"),
        ("tau_s,adev_ug,temperature_degC", "Allan deviations"),
        ("time_s,rate_deg_s,temperature_degC", "a gyro"),
    ],
)
def test_what_is_of_another_kind_is_refused_by_its_name(tmp_path, header, looks):
    with pytest.raises(TableError) as refused:
        kind_of(table(tmp_path, header))
    assert f"line 1: this looks like a table of {looks}" in str(refused.value)
    assert "which this version does not analyse; tumble reads an accelerometer on a head" in str(refused.value)


@pytest.mark.parametrize(
    ("header", "said"),
    [
        ("angle_degs,Voltage_v,temperature_degC", "is angle_degs angle_deg and Voltage_v voltage_V? Rename"),
        ("angle_deg,Voltage_v", "column voltage_V is missing; is Voltage_v voltage_V?"),
        ("angle_deg,refrence_deg", "is refrence_deg reference_deg?"),
        ("Angle_deg,voltage_V", "is Angle_deg angle_deg?"),
        ("temperature_degC,battery_V", "column battery_V says no parameter of a sensor with its unit"),
        ("temperature_degC,bias", "column bias says no parameter of a sensor with its unit"),
        ("temperature_degC,a_x_g,a_y_g,a_z_g", "columns a_x_g, a_y_g and a_z_g say no parameter"),
        ("temperature_degC,bias_mV,fan_percent", "column fan_percent says no parameter"),
        ("temperature_K,bias_mV", "column angle_deg, or a temperature in °C (…_degC) is missing"),
        ("position_id,outer_deg,inner_deg,u_x_V,u_y_V,temperature_degC", "a table of a triad, and it lacks u_z_V;"),
        ("table_deg,u_x_V,u_y_V,u_z_V", "a table of a triad, and it lacks outer_deg and inner_deg;"),
        ("time_s,table_deg,u_x_counts,u_y_counts,u_z_counts", "a table of a triad, and it lacks outer_deg, inner_deg,"),
        ("time_s,acc_x,acc_y,acc_z", "a table of a triad, and it lacks outer_deg, inner_deg,"),
        ("dwell,time_s,kind,drive_Hz,output_g", "these are samples of dwells; `tumble reduce` makes a table of dwells"),
        ("time_s,ai_g,fi_Hz,Output_ug", "is Output_ug output_ug?"),
        ("Angle (deg),Voltage (V)", "is 'Angle (deg)' angle_deg and 'Voltage (V)' voltage_V?"),
        ("first,s", "the columns are first, 's'; tumble reads"),
        ("first,second", "not a table that tumble knows; the columns are first, second; tumble reads"),
    ],
)
def test_a_table_of_no_kind_is_refused_with_what_is_there(tmp_path, header, said):
    with pytest.raises(TableError) as refused:
        kind_of(table(tmp_path, header))
    assert said in str(refused.value)


@pytest.mark.parametrize(
    "name", ["time_s", "time_h", "t_min", "run", "row", "samples", "date", "dwell_s", "duration_h"]
)
def test_times_and_counts_are_no_parameters(name):
    assert column_of(name) in (Column.TIME, Column.ORDINAL)


@pytest.mark.parametrize(
    ("name", "unit"),
    [("bias_deg_h", "deg_h"), ("kx_V_per_g", "V_per_g"), ("scale_x_percent", "percent"), ("angle_1_arcsec", "arcsec")],
)
def test_a_unit_is_read_whole(name, unit):
    assert (column_of(name), unit_of(name)) == (Column.PARAMETER, unit)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "time_s,sensor_degC,bias_V\n" + "\n".join(f"{n},{20 + n},1" for n in range(9)),
            "rows 1 s apart look like a log",
        ),
        (
            "timestamp_s,sensor_degC,bias_V\n" + "\n".join(f"{n},{20 + n},1" for n in range(9)),
            "rows 1 s apart look like a log",
        ),
        (
            "t_ms,sensor_degC,bias_V\n" + "\n".join(f"{2000 * n},{20 + n},1" for n in range(9)),
            "rows 2 s apart look like a log",
        ),
        (
            "time_h,sensor_degC,bias_V\n" + "\n".join(f"{0.01 * n},{20 + n},1" for n in range(9)),
            "rows 36 s apart look like a log",
        ),
        (
            "sensor_degC,bias_V\n10,1\n20,1_0\n30,1\n40,1",
            "line 3, column bias_V: '1_0' is not a number",
        ),
        ("sensor_degC,bias_V\n" + "\n".join(f"{n % 60},1" for n in range(300)), "300 rows look like a log"),
        ("sensor_degC,bias_V\n253,1\n273,1\n293,1\n313,1", "from 253 to 313 °C; are these kelvin"),
        ("sensor_degC,bias_V\n10,1\n20,1.1\n30,1e6\n40,1.2", "line 4, column bias_V: 1e[+]06 lies more than 100 times"),
        ("sensor_degC,time_h\n10,1\n20,2\n30,3\n40,4", "there is no parameter beside the temperature"),
    ],
)
def test_what_cannot_be_runs_of_calibration_is_refused(tmp_path, text, said):
    (tmp_path / "runs.csv").write_text(text + "\n", "utf-8")
    with pytest.raises(TableError, match=said):
        read_runs(tmp_path / "runs.csv")


def test_a_run_with_a_missing_value_is_set_aside_by_name(tmp_path):
    lines = ["sensor_degC,bias_V", "10,1.0", "20,#N/A", "30,1.2", "40,1.3", "50,1.4"]
    (tmp_path / "runs.csv").write_text("\n".join(lines) + "\n", "utf-8")
    runs = read_runs(tmp_path / "runs.csv")
    assert len(runs) == 4
    assert [(entry.row, entry.reason) for entry in runs.set_aside] == [(2, "bias_V has no value")]


def runs_with(tmp_path, column, values):
    lines = [f"{value},{10 * place},{1 + 0.1 * place}" for place, value in enumerate(values)]
    (tmp_path / "runs.csv").write_text("\n".join([f"{column},sensor_degC,bias_V", *lines]) + "\n", "utf-8")
    return read_runs(tmp_path / "runs.csv")


@pytest.mark.parametrize(
    ("column", "values", "time_s"),
    [
        ("time_h", [0, 1, 2, 4], [0, 3600, 7200, 14400]),
        ("timestamp_ms", [0, 9e4, 18e4, 27e4], [0, 90, 180, 270]),
        ("elapsed_min", [5, 15, 10, 20], [300, 900, 600, 1200]),
    ],
)
def test_the_times_of_runs_are_known_in_seconds_whatever_their_unit(tmp_path, column, values, time_s):
    assert runs_with(tmp_path, column, values).time_s.tolist() == pytest.approx(time_s)


def test_how_long_something_took_is_no_time_of_a_run(tmp_path):
    assert runs_with(tmp_path, "settling_s", [30, 31, 30, 29]).time_s is None


def test_digits_with_an_underline_between_them_are_a_remark():
    assert not holds_numbers(0, [(2, ["1_0"]), (3, [""])])


@pytest.mark.parametrize("header", ["angle_deg;voltage_V", "#N/A,angle_deg,voltage_V", "sep=;\nangle_deg;voltage_V"])
def test_a_header_is_split_as_the_rows_are(tmp_path, header):
    (tmp_path / "t.csv").write_text(f"{header}\n", "utf-8")
    assert {"angle_deg", "voltage_V"} <= set(read_header(tmp_path / "t.csv"))


def test_a_header_without_an_end_is_none(tmp_path):
    (tmp_path / "t.csv").write_bytes(b"\0" * 100_000)
    assert read_header(tmp_path / "t.csv") == []


def test_one_temperature_in_another_unit_is_named_by_its_line(tmp_path):
    path = tmp_path / "runs.csv"
    rows = ("20,2.5,1000", "25,2.6,1001", "293,2.7,1002", "35,2.8,1003", "40,2.9,1004", "45,3,1005")
    path.write_text("temperature_degC,u0_V,kx_mV\n" + "\n".join(rows) + "\n")

    with pytest.raises(TableError, match=r"line 4, column temperature_degC: no sensor of a run reads 293 °C"):
        read_runs(path)


class Strange:
    """A method of a package that fails at whatever it is asked."""

    columns = "nothing"

    def __init__(self, name):
        self.name = name  # a warning is given once in a process

    def reads(self, header, numbers):
        raise AttributeError("no such column")

    hint = reads


def test_a_method_that_fails_at_a_header_stops_no_other(tmp_path, caplog):
    path = table(tmp_path, "angle_deg,voltage_V,temperature_degC")

    assert recognised(path, (Strange("strange"), *methods())).name == "dividing_head"
    assert "the method strange fails at the columns of a table (AttributeError: no such column)" in caplog.text


def test_a_method_that_fails_at_a_hint_hides_none(tmp_path):
    path = table(tmp_path, "angle,voltage_V,reference_deg")

    with pytest.raises(TableError) as without:
        recognised(path, methods())
    with pytest.raises(TableError) as beside:
        recognised(path, (*methods(), Strange("odd")))
    assert str(beside.value).startswith(str(without.value).split("; tumble reads")[0])


@pytest.mark.parametrize(
    ("header", "hint"),
    [
        ("time_s,level_g,output_ug", "this looks like a table of vibrated dwells, and it lacks ai_g"),
        ("time_s,azimuth_deg,latitude_deg", "this looks like a table of a gyrocompass, and it lacks rate_deg_h"),
    ],
)
def test_what_a_table_of_another_method_lacks_is_named(tmp_path, header, hint):
    (tmp_path / "unit.csv").write_text(f"{header}\n" + ",".join("1" for _ in header.split(",")) + "\n", "utf-8")
    with pytest.raises(TableError, match=hint):
        recognised(tmp_path / "unit.csv", methods())


def test_a_name_in_the_missing_unit_is_asked_about_by_the_method_whose_other_column_is_there(tmp_path):
    with pytest.raises(TableError, match=r"column voltage_V is missing; is output_v voltage_V[?]"):
        kind_of(table(tmp_path, "angle_deg,output_v,time_s,realisation"))
