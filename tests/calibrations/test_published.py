import pytest
from tables import FLIPS, UNIT, sweep, table

from tumble.calibrations.methods.dividing_head.published import published_method


def test_the_published_equations_give_an_exact_sweep_back():
    found = published_method(table(*FLIPS, sweep("face-up"), noise_v=0.0))

    assert {name: found[name].value for name in ("u0", "kx", "ky", "kxy", "alpha0")} == pytest.approx(
        {name: UNIT[name] for name in ("u0", "kx", "ky", "kxy", "alpha0")}
    )


def test_a_negative_kxy_does_not_move_alpha0_by_a_quarter_turn():
    found = published_method(table(sweep("face-up"), noise_v=0.0, unit=dict(UNIT, kxy=-0.001)))

    assert found["kxy"].value == pytest.approx(-0.001)
    assert found["alpha0"].value == pytest.approx(UNIT["alpha0"])


def test_the_z_flip_errs_by_kx_sin_alpha0_as_equation_11_does():
    found = published_method(table(*FLIPS, sweep("face-up"), noise_v=0.0))

    assert found["kz"].value == pytest.approx(UNIT["kz"] + 1.0 * 0.0019565, abs=1e-6)


def test_without_a_sweep_the_flips_answer():
    found = published_method(table(*FLIPS, noise_v=0.0))

    assert found["kx"].value == pytest.approx(1.0, abs=1e-4)
    assert found["alpha0"].value is None
    assert found["alpha0"].reason == "needs a face-up sweep or flip"


def test_the_uncertainty_is_the_scatter_between_realisations():
    one = published_method(table(sweep("face-up"), realisations=1))["u0"]
    many = published_method(table(sweep("face-up"), realisations=40, seed=2))["u0"]

    assert one.standard_uncertainty is None
    assert many.standard_uncertainty == pytest.approx(1e-4 / 80**0.5 / 40**0.5, rel=0.3)


def test_too_few_angles_for_five_coefficients_are_no_sweep():
    assert published_method(table(("sweep", "face-up", [0.0, 90.0, 180.0, 270.0]), noise_v=0.0))["kxy"].value is None


def test_a_dead_unit_gives_numbers_all_the_same():
    dead = table(sweep("face-up"), noise_v=0.0)
    dead.voltage_v[:] = 0.0

    assert published_method(dead)["alpha0"].value == 0.0
