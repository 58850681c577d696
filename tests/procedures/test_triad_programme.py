"""Programmes of a triad: lists, orders, temperatures."""

import pytest

from tumble.procedures.errors import ProgrammeError
from tumble.procedures.programmes import load_programme, programme_from_text, shipped_programmes
from tumble.procedures.steps import Ask, Dwell

LISTS = {"24": 24, "18": 18, "12": 12, "6": 6, "24f": 24, "16o": 16, "12o": 12, "8o": 8}


def programme(text):
    return programme_from_text(f'method = "triad"\nname = "mine"\n{text}', "mine.toml")


def steps_of(programme):
    """All steps, answered as a nominal unit would be."""
    from tumble.procedures.plan import plan

    acquisition = programme.acquisition(samples=10, rate_hz=100.0)
    speeds = {"outer": 20.0, "inner": 20.0}
    return [each.step for each in plan(programme, acquisition, speeds_deg_s=speeds).steps]


def places(text):
    return [tuple(step.targets_deg.values()) for step in steps_of(programme(text)) if isinstance(step, Dwell)]


@pytest.mark.parametrize(("name", "positions"), LISTS.items())
def test_the_lists_of_the_digest_come_along(name, positions):
    assert name in shipped_programmes()
    assert len(steps_of(load_programme(name))) == positions


def test_24_takes_every_face_twice():
    taken = [tuple(step.targets_deg.values()) for step in steps_of(load_programme("24"))]
    faces = [place for place in taken if all(angle % 90.0 == 0.0 for angle in place)]
    assert (len(set(taken)), len(faces)) == (22, 12)


def test_there_and_back_comes_back_from_the_last():
    own = 'procedure = [{ positions = [[90, 0], [0, 45]], order = "there-and-back" }]'
    assert places(own) == [(90, 0), (0, 45), (0, 45), (90, 0)]


def test_every_realisation_is_shuffled_anew_and_the_same_again():
    own = 'realisations = 2\nprocedure = [{ list = "24", order = "shuffled", seed = 3 }]'
    taken = places(own)
    assert sorted(taken[:24]) == sorted(taken[24:])
    assert taken[:24] != taken[24:]
    assert taken == places(own)


def test_a_soak_comes_before_the_positions_of_its_temperature():
    steps = steps_of(programme("temperatures_degC = [30, 60.5]\nprocedure = [{ positions = [[90, 0]] }]"))
    assert [step.value if isinstance(step, Ask) else step.conditions["chamber"] for step in steps] == [
        "30", "30", "60.5", "60.5",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('procedure = [{ list = "25" }]', "no list is called '25'; known are 24, 18, 12, 6"),
        ("procedure = [{ }]", "name one list, or give positions, and not both"),
        ('procedure = [{ list = "24", positions = [[0, 0]] }]', "name one list, or give positions, and not both"),
        ('realisations = 10000\nprocedure = [{ list = "24" }]', "240,000 dwells or more"),
    ],
)
def test_a_programme_that_cannot_be_is_refused(text, said):
    with pytest.raises(ProgrammeError, match=said):
        programme(text)


def test_a_table_of_positions_is_a_programme(tmp_path):
    path = tmp_path / "mine.csv"
    path.write_text("# by exchange\nouter_deg,inner_deg\n90,0\n-45,135.5\n", "utf-8")
    own = load_programme(path)
    assert (own.name, own.method) == ("mine", "triad")
    assert [tuple(step.targets_deg.values()) for step in steps_of(own)] == [(90.0, 0.0), (-45.0, 135.5)]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("outer_deg,inner_deg\n90,north\n", "'north' in inner_deg is no angle; correct it"),
        ("outer_deg,inner_deg\n90\n", "None in inner_deg is no angle"),
        ("angle_deg\n90\n", "no method measures at settings of these columns"),
        ("outer_deg,inner_deg,u_x_V,u_y_V,u_z_V\n0,0,1,2,3\n", "no method measures at settings of these columns"),
    ],
)
def test_a_table_that_is_no_list_of_positions_is_refused(text, said, tmp_path):
    path = tmp_path / "mine.csv"
    path.write_text(text, "utf-8")
    with pytest.raises(ProgrammeError, match=said):
        load_programme(path)
