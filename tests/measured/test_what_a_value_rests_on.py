"""What the console remarks of values that rest on little."""

from app_jobs import tumble


def test_what_a_value_stands_on_is_remarked(shared):
    sweeps = tumble("fit", shared / "cases" / "19-absorbed-k_xx-sweeps-only.csv", "--verbose").out
    flips = tumble("fit", shared / "data" / "flip_mpu9250_y.csv", "--verbose").out

    assert "rests on kxy alone" in sweeps
    assert "given alpha0 = 0°" in flips
    assert "flip closure: u0 of the y and z flips differ by 6.5 mV, 18.2 standard uncertainties" in flips
