"""Careless numbers are refused at once, and what ends a command early has its own exit status."""

import errno
import subprocess
import sys
from pathlib import Path

import pytest
from app_jobs import STAND, tumble

ROOT = Path(__file__).resolve().parents[2]
PROGRAMME = """
name = "big"
realisations = {realisations}

[[procedure]]
kind = "sweep"
step_deg = 0.001
points = {points}
"""


@pytest.mark.parametrize(("realisations", "points"), [(1_000_000, 2), (1, 10_000_000), (10_000, 100_000)])
def test_a_programme_that_would_never_end_is_refused(write, realisations, points):
    programme = write("big.toml", PROGRAMME.format(realisations=realisations, points=points))

    assert tumble("plan", programme).status == 2


@pytest.mark.parametrize("change", ["rate_hz = 1e12", "rate_hz = 1e-9"])
def test_a_rate_that_no_daq_has_is_refused(write, change):
    stand = write("bench.toml", STAND.replace("[daq]\n", f"[daq]\n{change}\n"))
    ran = tumble("plan", "quick", "--stand", stand)

    assert ran.status == 2
    assert "rate_hz" in ran.err


def test_a_speed_that_never_arrives_is_refused(write):
    stand = write("bench.toml", STAND.replace("[head]\n", "[head]\nspeed_deg_s = 1e-9\n"))

    assert tumble("plan", "quick", "--stand", stand).status == 2


@pytest.mark.parametrize("serial", ["", "  ", "x" * 300])
def test_a_serial_number_nobody_could_read_is_refused(serial):
    assert tumble("run", "--programme", "quick", "--serial", serial).status == 2


def test_serial_numbers_that_differ_get_folders_that_differ():
    from tumble.app.recording_names import as_file_name

    assert as_file_name("SN-7") == "SN-7"
    assert len({as_file_name(text) for text in ("SN/7", "SN:7", "日本", "本日", "NUL", "nul", "..")}) == 7


def test_standard_output_on_a_full_disk_is_a_matter_of_storage(monkeypatch):
    def full(_planned):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("tumble.app.commands.plan._summary", full)

    assert tumble("plan", "quick").status == 5


def test_a_reader_who_has_seen_enough_is_no_error():
    command = [sys.executable, "-m", "tumble", "plan", "reversal"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=ROOT) as process:
        process.stdout.readline()
        process.stdout.close()
        complaint = process.stderr.read()

    assert (process.returncode, complaint) == (0, b"")
