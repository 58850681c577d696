import os

import pytest

from benchmarks.endurance.peers import readable_after_kill

pytestmark = pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGKILL")


@pytest.mark.parametrize(("recorder", "read"), [("tumble", 20), ("mcap", 0)])
def test_points_that_can_be_read_after_a_kill(recorder, read):
    assert readable_after_kill(recorder, points=20, pace_s=0.0) == read
