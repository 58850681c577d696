"""A million rows fit into memory, and what has no end is not read."""

import os
import tracemalloc

import numpy as np
import pytest
from tables import sweep, table

from tumble.calibrations.core.bounded import check_bounded
from tumble.calibrations.core.cells import TableError
from tumble.calibrations.core.compression import compress
from tumble.calibrations.methods.dividing_head.analysis import analyse
from tumble.calibrations.methods.dividing_head.budget import StandUncertainty, sources
from tumble.calibrations.methods.dividing_head.joint import fit_jointly
from tumble.calibrations.methods.dividing_head.loop.loop import explain
from tumble.calibrations.methods.dividing_head.model import basis
from tumble.calibrations.methods.dividing_head.table import read_table

STAND = StandUncertainty(head_accuracy_arcsec=5.0, seating_arcsec=10.0, daq_gain=1e-5, daq_offset_v=5e-6)


@pytest.fixture(scope="module")
def wide():
    """7,200 settings of one head, as far as a step of 0.05 deg gets: as a matrix their errors take 0.4 GB."""
    return table(sweep("face-up", step_deg=0.05), sweep("edge", step_deg=0.05), realisations=1)


def test_errors_of_many_settings_take_no_matrix(wide):
    tracemalloc.start()
    analyse(wide, STAND, trials=200)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()

    assert peak < 100e6


def test_an_error_that_rows_share_is_what_a_column_for_each_would_be():
    rows = table(sweep("face-up"), sweep("edge"), realisations=2)
    rotation = compress(basis(rows), rows.output_v, np.ones(len(rows))).rotation

    for source in sources(fit_jointly(rows).scene, STAND)[:2]:
        columns = np.zeros((len(rows), source.shared_by.max() + 1))
        columns[np.arange(len(rows)), source.shared_by] = source.errors_v[:, 0]
        np.testing.assert_allclose(source.turned(rotation), rotation.T @ columns, rtol=1e-12, atol=1e-15)


def test_many_errors_are_drawn_with_the_covariance_of_all(wide):
    found = analyse(wide, STAND, trials=4000)

    simulated, _ = found.monte_carlo["kx"]
    assert simulated == pytest.approx(found.parameters["kx"].standard_uncertainty, rel=0.05)


def test_a_table_too_long_to_be_traced_says_so(monkeypatch):
    monkeypatch.setattr("tumble.calibrations.methods.dividing_head.loop.loop.MOST_TRACED", 100)

    loop, explained = explain(table(sweep("face-up"), realisations=2))

    assert explained is None
    said = "its 160 rows are more than the 100 that are traced at once; give means or a part of them"
    assert loop.not_traced == said
    assert loop.augmented.warnings[-1] == f"table: nothing was traced: {said}"
    assert loop.declared.parameters["kx"].value == pytest.approx(1.0, abs=1e-3)


def test_a_table_of_too_many_lines_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr("tumble.calibrations.core.files.MOST_ROWS", 2)
    (tmp_path / "t.csv").write_text("angle_deg,voltage_V\n0,1\n1,1\n2,1\n")

    with pytest.raises(TableError, match=r"t\.csv: holds 4 lines, and at most 2 are read; cut it into several tables"):
        read_table(tmp_path / "t.csv")


def test_a_table_that_is_nothing_but_room_is_refused_unread(tmp_path):
    (tmp_path / "t.csv").touch()
    os.truncate(tmp_path / "t.csv", 2**40)

    with pytest.raises(TableError, match="1,048,576 MiB, where at most 256 are read"):
        read_table(tmp_path / "t.csv")


@pytest.mark.skipif(os.name == "nt", reason="devices of POSIX")
def test_a_pipe_or_a_device_is_refused_unread(tmp_path):
    os.mkfifo(tmp_path / "pipe.csv")

    with pytest.raises(TableError, match=r"pipe\.csv: cannot be read \(no file but a device or a pipe"):
        read_table(tmp_path / "pipe.csv")
    with pytest.raises(OSError, match="which may have no end"):
        check_bounded(tmp_path / "pipe.csv")
