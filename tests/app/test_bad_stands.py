import pytest
from app_jobs import STAND, tumble

BAD = {
    "a bracket is missing": (
        ("[daq]", "[daq"),
        "line 10: not TOML: Expected ']' at the end of a table declaration; correct it",
    ),
    "an unknown key": (
        ("[daq]\n", "[daq]\ndwell_ms = 5\n"),
        "line 11: daq: dwell_ms: Extra inputs are not permitted; correct its spelling or take it out",
    ),
    "no limits": (("limits_deg = [-180.0, 760.0]\n", ""), "line 6: head: limits_deg: Field required; add it"),
    "text for limits": (
        ("[-180.0, 760.0]", '"all"'),
        "line 8: head: limits_deg: Input should be a valid tuple; correct it",
    ),
    "limits the wrong way": (
        ("[-180.0, 760.0]", "[760.0, -180.0]"),
        "line 6: head: limits_deg: 760 is not below -180; correct it",
    ),
    "no limit at all": (
        ("[-180.0, 760.0]", "[-180.0, inf]"),
        "line 8: head: limits_deg 2: Input should be a finite number; correct it",
    ),
    "an unknown driver": (
        ('[daq]\ndriver = "simulated"', '[daq]\ndriver = "abacus"'),
        "line 11: daq: driver: no driver is called 'abacus'; known are can, lines, scanner, scpi, simulated, "
        "or write FILE.py:NAME; ",
    ),
    "an unknown preset": (
        ("DXL203EB", "DXL"),
        "line 14: simulated: preset: unknown preset 'DXL'; known are DXL203EB, ideal; correct it",
    ),
    "an unknown effect": (
        ('"DXL203EB"\n', '"DXL203EB"\neffects = { wobble = 1.0 }\n'),
        "line 15: simulated: effects: unknown effect 'wobble'; known are axis_tilt, ",
    ),
    "latitude and gravity": (
        ("[site]\n", "[site]\ngravity_m_s2 = 9.81\n"),
        "line 3: site: latitude_deg and gravity_m_s2 both given: say where the stand is in one of the two ways",
    ),
    "a date that is none": (
        ("[head]\n", '[head]\ncalibration_due = "soon"\n'),
        "line 7: head: calibration_due: Input should be a valid date",
    ),
    "no counts per degree": (
        ("[head]\n", "[head]\nsteps_per_deg = 0.0\n"),
        "line 6: head: steps_per_deg is 0: give the counts per degree; correct it",
    ),
    "a port that cannot be": (
        ('[daq]\ndriver = "simulated"', '[daq]\ndriver = "scpi"\nurl = "socket://127.0.0.1:99999"'),
        "line 12: daq: url: 'socket://127.0.0.1:99999' names no host and port; write such as socket://127.0.0.1:7001",
    ),
    "no port": (
        ('[daq]\ndriver = "simulated"', '[daq]\ndriver = "simulated"\nurl = "socket://127.0.0.1"'),
        "line 12: daq: url: 'socket://127.0.0.1' names no host and port; ",
    ),
    "an unknown scheme": (
        ('[daq]\ndriver = "simulated"', '[daq]\ndriver = "scpi"\nurl = "sockt://127.0.0.1:1"'),
        "line 10: daq: 'sockt://127.0.0.1:1' begins with sockt://, and a serial line with a port name or socket://, ",
    ),
    "a bus without a server": (
        ('[daq]\ndriver = "simulated"', '[daq]\ndriver = "can"\nurl = "socketcand:can0?host=127.0.0.1&port=99999"'),
        "line 10: daq: 'socketcand:can0?host=127.0.0.1&port=99999' names no server; write such as socketcand:can0?",
    ),
    "an option that no server has": (
        (
            '[daq]\ndriver = "simulated"',
            '[daq]\ndriver = "can"\nurl = "socketcand:can0?host=127.0.0.1&port=7003&bitrat=5"',
        ),
        "line 10: daq: 'socketcand:can0?host=127.0.0.1&port=7003&bitrat=5': socketcand has no option bitrat, only "
        "host, port, tcp_tune; leave it out (the bit rate is set at the server)",
    ),
}


def run_with(stand, tiny, tmp_path):
    ran = tumble("run", "--stand", stand, "--programme", tiny, "--serial", "A", "--store", tmp_path / "store")
    assert ran.status == 2
    assert not (tmp_path / "store").exists()
    return ran.complaint


@pytest.mark.parametrize(("change", "complaint"), BAD.values(), ids=BAD)
def test_a_bad_stand_file_is_named_with_line_and_remedy(write, tiny, tmp_path, change, complaint):
    assert STAND.count(change[0]) == 1
    stand = write("bad.toml", STAND.replace(*change))

    assert run_with(stand, tiny, tmp_path).startswith(f"{stand}, {complaint}")


def test_a_stand_file_without_a_name_is_named(write, tiny, tmp_path):
    stand = write("bad.toml", STAND.replace('name = "bench-1"\n', ""))

    assert run_with(stand, tiny, tmp_path) == f"{stand}: name: Field required; add it"


def test_a_stand_file_that_is_not_utf_8_is_told_so(write, tiny, tmp_path):
    stand = write("bad.toml", STAND.replace("bench", "b\xe4nk").encode("latin-1"))

    assert run_with(stand, tiny, tmp_path) == f"{stand}: byte 9 is not UTF-8; save the file as UTF-8"


def test_a_stand_file_that_is_not_there_is_named(tiny, tmp_path):
    stand = tmp_path / "none.toml"

    assert run_with(stand, tiny, tmp_path) == f"{stand}: No such file or directory; give a file that can be read"


@pytest.mark.parametrize("command", [("plan", "quick"), ("fit", "table.csv")])
def test_every_command_that_reads_a_stand_file_complains_alike(write, tmp_path, monkeypatch, command):
    monkeypatch.chdir(tmp_path)
    write("table.csv", "angle_deg,voltage_V\n0,2.5\n")
    write("bad.toml", STAND.replace("limits_deg", "limit_deg"))

    ran = tumble(*command, "--stand", "bad.toml")

    assert ran.status == 2
    assert ran.complaint.startswith("bad.toml, line 6: head: limits_deg: Field required; add it")


def test_physics_of_somebody_elses_making_is_run(write, tiny, tmp_path):
    write("physics.py", "def response(ax, ay, az, temperature, time):\n    return 4.5\n")
    stand = write("own.toml", STAND + 'response = "physics.py:response"\nnoise_v = 0.0\n')
    tumble("run", "--stand", stand, "--programme", tiny, "--serial", "A", "--out", tmp_path / "x.mcap")

    tumble("export", tmp_path / "x.mcap")

    assert "4.5,0.0,10" in (tmp_path / "x.csv").read_text()


def test_physics_that_cannot_be_loaded_is_named(write, tiny, tmp_path):
    stand = write("own.toml", STAND + 'response = "physics.py:response"\n')

    assert f"{stand}: {tmp_path / 'physics.py'} could not be loaded" in run_with(stand, tiny, tmp_path)
