"""Break points of a spectrum, as they are read."""

import pytest

from tumble.calibrations.core.cells import TableError
from tumble.calibrations.methods.vibration.profile import read_profile


@pytest.mark.parametrize("density", ["nan", "-0.02", "0", "inf", "1e300", "1e-320"])
def test_a_density_that_no_spectrum_has_is_refused(tmp_path, density):
    path = tmp_path / "spectrum.csv"
    path.write_text(f"f_Hz,G_g2_Hz\n20,0.01\n100,{density}\n500,0.01\n")

    with pytest.raises(TableError, match=r"spectrum\.csv: the break points of a spectrum are two rows at least"):
        read_profile(path)
