"""Gross errors of a triad that are none: many dwells that stand out together are structure."""

from triad_tables import made, read

from tumble.calibrations.methods.triad.loop import close_triad_loop


def test_dwells_after_a_large_jump_are_no_gross_errors(tmp_path):
    columns = made("24", passes=3)
    columns["u_x_V"][49:] += 3.5e-4

    loop = close_triad_loop(read(tmp_path, columns))

    assert loop.observations.set_aside == ()
    assert (loop.unexplained.depends_on, loop.unexplained.channel) == ("time", "offset")


def test_a_gross_error_beside_a_large_jump_is_left_out(tmp_path):
    columns = made("24", passes=3)
    columns["u_x_V"][49:] += 3.5e-4
    columns["u_y_V"][60] -= 5e-3

    loop = close_triad_loop(read(tmp_path, columns))

    assert [each.row for each in loop.observations.set_aside] == [61]
    assert (loop.unexplained.depends_on, loop.unexplained.channel) == ("time", "offset")


def test_gross_errors_here_and_there_are_no_structure(tmp_path):
    columns = made("24", passes=3)
    for dwell, error_v in ((4, 2e-3), (19, -3e-3), (33, 4e-3), (47, -1e-3), (58, 2e-3), (66, 5e-3)):
        columns["u_z_V"][dwell] += error_v

    loop = close_triad_loop(read(tmp_path, columns))

    assert [each.row for each in loop.observations.set_aside] == [5, 20, 34, 48, 59, 67]
    assert loop.effects == ()
    assert loop.unexplained is None
