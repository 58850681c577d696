"""A driver file of version 0.1 goes on: it imports the names of then."""

from tumble.drivers import protocols
from tumble.drivers.own_file import load_from_file

DRIVER = """
from tumble.drivers.protocols import Daq, DividingHead, HeadStatus, SampleBlock


def look(head: DividingHead, daq: Daq) -> HeadStatus:
    return HeadStatus(angle_deg=1.0, moving=False, device_time_s=0.0)
"""


def test_the_names_of_version_0_1_mean_the_same(tmp_path):
    (tmp_path / "mine.py").write_text(DRIVER, "utf-8")
    look = load_from_file("mine.py:look", tmp_path)
    assert look(None, None) == protocols.PositionerStatus(angle_deg=1.0, moving=False, device_time_s=0.0)
    assert look.__annotations__ == {
        "head": protocols.Positioner,
        "daq": protocols.Sampler,
        "return": protocols.PositionerStatus,
    }
