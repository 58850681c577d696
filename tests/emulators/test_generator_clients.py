"""Clients that nobody here wrote, at the emulated function generator over TCP."""

import re
import warnings
from contextlib import contextmanager

import pytest

from benchmarks.endurance.shaker import GENERATOR, METERS, served

with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    from pymeasure.instruments.agilent import Agilent33500
    from qcodes.instrument_drivers.Keysight import Keysight33522B

pytestmark = pytest.mark.filterwarnings("ignore")


@contextmanager
def shaker(folder):
    """VISA resource name of an emulated generator, and its stand."""
    with served(folder, f"{GENERATOR}\n{METERS}") as stand:
        port = re.search(r":(\d+)$", stand.job.stand.file.exciters["exciter"].url)[1]
        yield f"TCPIP::127.0.0.1::{port}::SOCKET", stand


def test_pymeasure_shakes(tmp_path):
    with shaker(tmp_path) as (name, stand):
        generator = Agilent33500(name, visa_library="@py", read_termination="\n", write_termination="\n", timeout=5000)
        generator.ch_1.output_load = "INF"
        generator.ch_1.shape, generator.ch_1.frequency, generator.ch_1.amplitude = "SIN", 80.0, 5.0
        generator.ch_1.output = True
        assert (generator.id.split(",")[1], generator.ch_1.frequency, generator.ch_1.output) == ("33522B", 80.0, True)
        assert stand.exciter.driven.text == "sine 5 g 80 Hz"
        assert generator.check_errors() == []
        generator.ch_1.output = False
        assert generator.ch_1.output is False
        assert stand.exciter.driven.text == "rest"
        generator.adapter.close()


def test_qcodes_shakes(tmp_path):
    with shaker(tmp_path) as (name, stand):
        generator = Keysight33522B("generator", name, visalib="@py", terminator="\n")
        generator.ch1.function_type("SIN")
        generator.ch1.frequency(80.0)
        generator.ch1.amplitude(5.0)
        generator.ch1.output("ON")
        assert (generator.ch1.frequency(), generator.ch1.output()) == (80.0, "ON")
        assert stand.exciter.driven.tones[0].frequency_hz == 80.0
        generator.close()
