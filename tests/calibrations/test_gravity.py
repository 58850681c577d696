import pytest

from tumble.calibrations.core.gravity import normal_gravity


@pytest.mark.parametrize(
    ("latitude_deg", "g_m_s2"),
    [(0.0, 9.7803253359), (90.0, 9.8321849379)],  # NIMA TR8350.2, table 3.4
)
def test_normal_gravity_at_equator_and_pole(latitude_deg, g_m_s2):
    assert normal_gravity(latitude_deg, 0.0).value_m_s2 == pytest.approx(g_m_s2, abs=1e-9)


def test_gravity_falls_by_0_3086_mgal_a_metre():
    fall = normal_gravity(45.0, 0.0).value_m_s2 - normal_gravity(45.0, 100.0).value_m_s2

    assert fall == pytest.approx(100 * 0.3086e-5, rel=1e-3)
