"""Tables of others give what they gave; one of each kind here, all of them by `python -m benchmarks.frozen`."""

from pathlib import Path

import pytest
from app_jobs import tumble

from benchmarks.frozen import OF_TABLES, differences, read, results, tables

SOME = (
    "cases/01-k_xx",
    "cases/11-misreading",
    "cases/16-clean-reversal",
    "cases/19-absorbed-k_xx-sweeps-only",
    "cases-public/01-nine-settings-four-pieces",
    "cases-public/02-joint",
    "cases-public/04-formula-error-in-first-column",
    "cases-public/11-left-still-to-warm-up",
    "data/flip_mpu9250_y",
)


def run(*arguments):
    return tumble(*arguments).status


@pytest.mark.parametrize("name", SOME)
def test_a_table_gives_its_frozen_results(shared, name, tmp_path: Path):
    now = results(run, tables()[name], tmp_path)

    assert list(differences(read(OF_TABLES / f"{name}.json"), now, relative=1e-6)) == []


def test_every_table_is_frozen(shared):
    assert sorted(tables()) == sorted(
        str(path.relative_to(OF_TABLES).with_suffix("")) for path in OF_TABLES.rglob("*.json")
    )
