"""Drivers are found by name or in a laboratory's own file; their keys are checked, and an analysis needs none."""

import sys
from pathlib import Path

import pytest
from app_jobs import STAND, tumble

from tumble.app.methods.dividing_head.uncertainty import HeadStand
from tumble.app.stand import load_stand
from tumble.procedures.errors import InputError

OWN = """
from tumble.drivers.driver import Driver
from tumble.drivers.tables import HeadTable

class Keys(HeadTable):
    gear: int = 1

HEAD = Driver(table=Keys, connect=print)
NUMBER = 7
"""
REAL = STAND.replace('[head]\ndriver = "simulated"', '[head]\ndriver = "lab.py:HEAD"').replace(
    '[daq]\ndriver = "simulated"', '[daq]\ndriver = "scpi"\nurl = "COM4"'
)


@pytest.fixture
def own(write):
    """Write the driver and a stand file that names it, changed a little."""

    def load(old="", new=""):
        write("lab.py", OWN)
        return load_stand(write("lab.toml", REAL.replace(old, new, 1)))

    return load


def test_a_driver_of_a_file_is_found_beside_the_stand_file(own):
    assert own().positioner_drivers["head"].connect is print


def test_keys_of_its_own_have_types_and_defaults(own):
    assert own().file.head.gear == 1
    assert own("[head]\n", "[head]\ngear = 3\n").file.head.gear == 3


@pytest.mark.parametrize(
    ("old", "new", "complaint"),
    [
        ("[head]\n", '[head]\ngear = "high"\n', "line 7: head: gear: Input should be a valid integer"),
        ("[head]\n", "[head]\ngears = 3\n", "line 7: head: gears: Extra inputs are not permitted; correct"),
        ("[daq]\n", "[daq]\ngear = 3\n", "line 11: daq: gear: Extra inputs are not permitted"),
        ("HEAD", "TAIL", "line 7: head: driver: {folder}/lab.py has no 'TAIL'; define it there"),
        ("HEAD", "NUMBER", "line 7: head: driver: lab.py:NUMBER is no driver whose table is a HeadTable"),
        ("lab.py", "absent.py", "line 7: head: driver: {folder}/absent.py could not be loaded (FileNotFoundError"),
        ('"scpi"', '"lab.py:HEAD"', "line 11: daq: driver: lab.py:HEAD is no driver whose table is a DaqTable"),
        ("lab.py:HEAD", "scpi", "line 7: head: driver: no driver is called 'scpi'; known are cia402, manual"),
    ],
)
def test_a_driver_that_cannot_be_used_is_told_with_its_line(own, tmp_path, old, new, complaint):
    with pytest.raises(InputError) as told:
        own(old, new)
    assert complaint.format(folder=tmp_path) in str(told.value)


def test_an_analysis_needs_no_driver(own):
    recorded = own("[head]\n", "[head]\ngear = 3\naccuracy_arcsec = 4.0\n").recorded

    assert HeadStand.model_validate(recorded).uncertainty.head_accuracy_arcsec == 4.0


def test_there_is_no_emulator_for_it(own, tmp_path):
    own()
    ran = tumble("emulate", "--stand", tmp_path / "lab.toml")

    assert ran.status == 2
    assert "there is no emulator for the driver lab.py:HEAD; there are some for" in ran.complaint


@pytest.mark.parametrize("former", ["drivers.driver", "drivers", "calibrations.table"])
def test_a_driver_written_for_the_first_version_is_told_the_new_import(own, write, monkeypatch, former):
    monkeypatch.setattr("sys.path", [place for place in sys.path if not (Path(place) / "drivers").is_dir()])
    monkeypatch.setattr(f"{__name__}.OWN", f"import {former}")

    with pytest.raises(InputError, match=rf"lab.py imports {former.partition('.')[0]}.*, which is tumble\.") as told:
        own()
    assert str(told.value).count("\n") == 0
