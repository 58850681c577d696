"""What a component gains, by another way than eigenvalues."""

import numpy as np
import pytest

from tumble.calibrations.tracing.gains import gain_of_process, gains


@pytest.mark.parametrize("count", [1, 2, 12])
def test_a_process_gains_what_its_eigenvalues_say(count: int) -> None:
    place = np.arange(60)
    columns = np.cos(np.outer(place, np.arange(1, count + 1)) * 0.1)
    output = 3.0 * columns[:, 0] + np.sin(7.0 * place)
    gram, along, squares = columns.T @ columns, columns.T @ output, float(output @ output)
    values, vectors = np.linalg.eigh(gram)
    (gain,), (variance,) = gains(values[None], ((vectors.T @ along) ** 2)[None], squares, 60)
    assert gain_of_process(gram, along, squares, 60) == pytest.approx((gain, variance))
