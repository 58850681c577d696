"""Small calibrations and stores for the tests of the records.

Run as a program it makes the fixture of the present format, which then stays as it is for good:

    python tests/calibrations/records_examples.py tests/calibrations/fixtures/records_v5.sqlite
"""

import hashlib
import sys
from datetime import UTC, datetime, timedelta
from functools import cache
from itertools import count
from pathlib import Path
from tempfile import TemporaryDirectory

from loop_examples import with_k_xx
from tables import FLIPS, UNIT, sweep, table

from tumble.calibrations.core.provenance import LimitCheck, Provenance, Source
from tumble.calibrations.methods.dividing_head.analysis import analyse
from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.records.store import DATABASE, Store

RAW = b"angle_deg,voltage_V\n0,2.5\n"


@cache
def calibration(seed=1, kx=1.0, parts=(*FLIPS, ("sweep", "face-down", tuple(range(0, 360, 15))))):
    """Flips and a face-down sweep, three times, without Monte Carlo."""
    unit = UNIT | {"kx": kx}
    return analyse(
        table(*parts, ("sweep", "face-up", tuple(range(0, 360, 15))), realisations=3, seed=seed, unit=unit), trials=0
    )


def sweep_only():
    """One mount: kz has no value."""
    return analyse(table(sweep("face-up"), realisations=2), trials=0)


def raw_source(path="runs/raw.csv", sha256=""):
    return Source(kind="table", path=path, sha256=sha256 or hashlib.sha256(RAW).hexdigest())


def provenance(**changed):
    return Provenance(
        **{
            "serial_number": "SN 17",
            "operator": "Олена",
            "programme_name": "seed",
            "programme_sha256": "ab" * 32,
            "stand_name": "bench-1",
            "stand": {"name": "bench-1", "head": {"limits_deg": [-180.0, 760.0]}},
            "sources": (raw_source(),),
            "measured_at": "2026-11-20T10:00:00+02:00",
            "program_version": "0.1.0",
            "git_commit": "df5531a",
            "packages": {"numpy": "2.2.0"},
            **changed,
        }
    )


KX_INSIDE = LimitCheck(name="kx", minimum=0.95, maximum=1.05, inside=True)
KY_OUTSIDE = LimitCheck(name="ky", minimum=None, maximum=0.001, inside=False)


def as_recorded(parameters):
    """What a record must keep of every parameter."""
    kept = "unit", "value", "standard_uncertainty", "type_a", "degrees_of_freedom", "interval_95", "reason", "condition"
    return [
        (name, *(getattr(each, field) for field in kept), each.rests_on, each.remark, each.settled_by)
        for name, each in parameters.items()
    ]


def minutes_pass():
    """A clock that says one minute more every time, from 2026-11-22 14:15:03 UTC on."""
    start = datetime(2026, 11, 22, 14, 15, 3, tzinfo=UTC)
    return (start + timedelta(minutes=minute) for minute in count()).__next__


def store_with_raw_file(folder):
    store = Store(folder, now=minutes_pass())
    (folder / "runs").mkdir(exist_ok=True)
    (folder / "runs" / "raw.csv").write_bytes(RAW)
    return store


def _write_fixture(target):
    with TemporaryDirectory() as folder:
        store = Store(Path(folder), now=minutes_pass())
        first = store.add(entry(calibration(), [KX_INSIDE, KY_OUTSIDE]), provenance())
        store.add(entry(with_k_xx().declared, loop=with_k_xx()), provenance(), supersedes=first.id)
        target.write_bytes((Path(folder) / DATABASE).read_bytes())


if __name__ == "__main__":
    _write_fixture(Path(sys.argv[1]))
