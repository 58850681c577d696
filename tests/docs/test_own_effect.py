"""The example of a laboratory's own effect, in the place where such a file goes."""

import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
PASTED = """
import json, sys
from importlib.util import spec_from_file_location
import tumble

class Pasted:
    def find_spec(self, name, path=None, target=None):
        place = "docs/examples/own.py"
        return spec_from_file_location(name, place) if name.endswith(".dividing_head.effects.own") else None

sys.meta_path.insert(0, Pasted())
effects = tumble.close_loop("docs/samples/lamp.csv").to_dict()["loop"]["effects"]
print(json.dumps({effect["name"]: effect["coefficients"] for effect in effects}))
"""
"""The example is loaded wherever `effects.own` is imported, as if its text had been pasted there."""


def test_the_example_works_as_pasted():
    ran = subprocess.run(
        [sys.executable, "-c", PASTED], cwd=ROOT, capture_output=True, text=True, timeout=60, check=False
    )
    assert ran.returncode == 0, ran.stderr
    effects = json.loads(ran.stdout)

    assert set(effects) == {"lamp", "k_xx"}
    assert abs(effects["lamp"]["lamp"]["value"] - 600e-6) < 50e-6
