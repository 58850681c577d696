import json
import os
import subprocess
import sys


def test_a_stream_is_recorded_without_a_loss_while_the_window_plots():
    ran = subprocess.run(
        [sys.executable, "-m", "benchmarks.window_streaming", "--minutes", "0.05"],
        env=os.environ | {"QT_QPA_PLATFORM": "offscreen"},
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    found = json.loads(ran.stdout)
    assert found["lost_samples"] == 0
    assert found["blocks"] == 60
    assert found["points_drawn"] == 3
