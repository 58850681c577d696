"""What experiments would add to the table of a triad, and what they would tell."""

import numpy as np
import pytest
from triad_tables import made, read

from tumble.calibrations.methods.triad.loop import asked_next, close_triad_loop
from tumble.calibrations.methods.triad.probes import PROBES, TriadProbe, probes, usual_step_s
from tumble.calibrations.methods.triad.table import triad_table
from tumble.calibrations.tracing.separation import PlannedRows, Question
from tumble.messages import Message
from tumble.procedures.programmes import load_programme

TWO = TriadProbe(programme="two", does=Message("x"), positions=((90.0, 45.0), (-45.0, 45.0)))


def asymmetric(g, outer_deg, inner_deg):
    """A scale factor asymmetry of channel x, which the twelve edges do not tell from a square."""
    return np.column_stack([4e-4 * np.abs(g[:, 0]), np.zeros((len(g), 2))])


@pytest.fixture(scope="module")
def edges(tmp_path_factory):
    return read(tmp_path_factory.mktemp("edges"), made("12", passes=2, added=asymmetric))


@pytest.fixture(scope="module")
def explained(edges):
    return close_triad_loop(edges).explained


@pytest.mark.parametrize("probe", PROBES, ids=lambda probe: probe.programme)
def test_a_probe_takes_the_positions_of_the_programme_of_its_name(probe):
    (listed,) = load_programme(probe.programme).parts

    assert probe.positions == tuple(listed.ordered(1))


def test_rows_of_a_probe_follow_those_of_the_table(edges):
    joined = TWO.after(edges)

    assert len(joined) == 26
    assert joined.outer_deg[-2:].tolist() == [90.0, -45.0]
    assert joined.realisation[-1] == 3
    assert joined.time_s[-1] - edges.time_s[-1] == pytest.approx(350.0)


def test_a_row_that_is_added_gives_three_outputs_with_the_weights_of_their_channels(edges):
    table = triad_table(edges)

    planned = PlannedRows.of(table).followed_by(TWO)

    assert len(planned.weights) == 3 * 26
    assert planned.weights[-6:] == pytest.approx(np.tile(table.weights[:3], 2))
    assert planned.programmes[-6:].tolist() == ["two"] * 6


def test_outputs_of_the_table_come_first_in_a_view_of_more_rows(edges):
    table = triad_table(edges)

    longer = table.view(TWO.after(edges), table.scene.theta)

    assert longer.output_v.ravel()[: table.rows] == pytest.approx(table.scene.output_v.ravel())
    assert table.functions(longer)[: table.rows] == pytest.approx(table.declared)


def test_other_positions_tell_what_the_edges_do_not(explained):
    (name,) = explained.close
    question = Question(explained.table, explained.trace, name, explained.close[name])
    edges, faces = (each for each in PROBES if each.programme in ("12", "24"))

    lists = {
        each.programme: question.expected(question.table.followed_by(each)).promises.min() for each in (edges, faces)
    }

    assert lists["24"] > 16.0 > lists["12"]


def test_what_to_measure_next_names_a_list_and_the_rivals(edges):
    experiment = asked_next(close_triad_loop(edges)).experiments[0]

    assert {"x.k_xx", "x.scale_asymmetry"} <= set(experiment.separates)
    assert experiment.command == f"tumble run --programme {experiment.programme} --serial SERIAL"


def test_a_probe_takes_as_long_as_the_dwells_of_the_table(edges):
    step_s = usual_step_s(edges)

    assert probes(step_s)[0].stand_time_s == pytest.approx(8 * 175.0)


def test_dwells_that_what_was_found_explains_are_no_gross_errors(tmp_path):
    """Twice the edges, then the faces for the first time: an asymmetry shows there as a misreading would."""
    edges, faces = made("12", passes=4, added=asymmetric), made("8o", added=asymmetric, seed=2)
    columns = {name: np.concatenate([values, faces[name]]) for name, values in edges.items()}
    columns["time_s"] = 175.0 * np.arange(len(columns["time_s"]))
    columns["u_y_V"][5] += 5e-3

    loop = close_triad_loop(read(tmp_path, columns))

    assert [each.row for each in loop.observations.set_aside] == [6]
    assert [each.name for each in loop.effects] == ["x.scale_asymmetry"]
