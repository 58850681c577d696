"""Programmes of a gyro platform: positions, order, bases, levelling."""

import pytest

from tumble.procedures.errors import ProgrammeError
from tumble.procedures.plan import plan
from tumble.procedures.programmes import load_programme, programme_from_text, shipped_programmes
from tumble.procedures.steps import Ask, Dwell

SHIPPED = {
    "0-90-180": [0, 90, 180],
    "0-90-180-270": [0, 90, 180, 270],
    "0-180-90-270": [0, 180, 90, 270],
    "0-90-180-90-0": [0, 90, 180, 90, 0],
    "0-120-240": [0, 120, 240],
}


def programme(text):
    return programme_from_text(f'method = "gyrocompass"\nname = "mine"\n{text}', "mine.toml")


def steps_of(programme):
    acquisition = programme.acquisition(samples=100, rate_hz=10.0)
    return [each.step for each in plan(programme, acquisition, speeds_deg_s={"azimuth": 9.0}).steps]


def azimuths_deg(programme):
    return [step.targets_deg["azimuth"] for step in steps_of(programme) if isinstance(step, Dwell)]


@pytest.mark.parametrize(("name", "positions"), SHIPPED.items())
def test_the_orders_of_the_digest_come_along(name, positions):
    assert name in shipped_programmes()
    assert azimuths_deg(load_programme(name)) == positions * 4


@pytest.mark.parametrize("positions", ['"0/180/90/270"', '" 0 / 180/90.0/270 "', "[0, 180, 90, 270]"])
def test_positions_are_a_text_or_a_list(positions):
    assert azimuths_deg(programme(f"procedure = [{{ positions = {positions} }}]")) == [0, 180, 90, 270]


def test_passes_follow_one_another_and_realisations_too():
    own = programme('realisations = 2\nprocedure = [{ positions = "0/90", repeats = 2 }]')
    assert azimuths_deg(own) == [0, 90, 0, 90] * 2
    assert [step.realisation for step in steps_of(own)] == [1] * 4 + [2] * 4


def test_a_base_is_asked_for_only_where_it_is_another():
    own = programme(
        'procedure = [{ positions = "0/90", base = 1 }, { positions = "0", base = 2 }, { positions = "5" }]'
    )
    asked = [step for step in steps_of(own) if isinstance(step, Ask)]
    assert [(ask.condition, ask.value) for ask in asked] == [("base", "1"), ("base", "2")]
    assert "Lean the base as number 2" in asked[1].prompt


def test_a_dwell_begins_when_the_platform_is_level_and_still():
    own = programme(
        'settle_samples = 20\ntilt_within_deg = 0.02\ntilt_rate_deg_h = 1.8\nprocedure = [{ positions = "0" }]'
    )
    acquisition = own.acquisition(samples=100, rate_hz=10.0)
    assert acquisition.settle_within == {"tilt_beta_deg": 0.02}
    assert acquisition.settle_change == {"tilt_beta_deg": pytest.approx(0.001)}  # in 2 s
    assert (acquisition.samples, acquisition.settle_s) == (100, 7.0)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('procedure = [{ positions = "0/north" }]', "'north' is no angle: write angles in degrees, as 0/90/180"),
        ("procedure = [{ positions = [] }]", "at least 1 item"),
        ('procedure = [{ positions = "0/5000" }]', "less than or equal to 3600"),
        ('procedure = [{ positions = "0", base = 0 }]', "greater than or equal to 1"),
        ('procedure = [{ positions = "0" }]\n[noise]\ncorrelation_s = 5', "the noise is nowhere greater than 0"),
        ('procedure = [{ positions = "0" }]\n[limits]\nheading = { min = 0, max = 1 }', "alpha0"),
        ('realisations = 10000\nprocedure = [{ positions = "0", repeats = 100 }]', "1,000,000 dwells or more"),
    ],
)
def test_a_programme_that_cannot_be_is_refused(text, said):
    with pytest.raises(ProgrammeError, match=said):
        programme(text)


def test_a_table_of_positions_is_a_programme(tmp_path):
    path = tmp_path / "mine.csv"
    path.write_text("azimuth_deg\n0\n-45.5\n", "utf-8")
    own = load_programme(path)
    assert (own.name, own.method, azimuths_deg(own)) == ("mine", "gyrocompass", [0.0, -45.5])


def test_a_table_of_rates_is_none(tmp_path):
    path = tmp_path / "mine.csv"
    path.write_text("azimuth_deg,rate_deg_h\n0,1.0\n", "utf-8")
    with pytest.raises(ProgrammeError, match="no method measures at settings of these columns"):
        load_programme(path)
