"""The bank through what one would otherwise use, beside `close_loop`.

    python -m benchmarks.alternatives [--seeds development|reported] [--count N]

- `stepwise`: forward selection by BIC.
- `lasso`: LassoCV of scikit-learn, then least squares on its support.
- `sindy`: sequentially thresholded least squares of PySINDy, its threshold by cross-validation.
- `process`: Gaussian-process regression of scikit-learn over all inputs, without physics: it names nothing.

The first three get the same rows, weights and columns (see `columns`), and are graded by the rule by which `close_loop`
is. Tables with a misread angle or a random walk are left out: a regression has no column for either. Tables of what no
catalogue names are those of `benchmarks.blind`. Held out are the parts that `close_loop` holds out; a method chooses
anew among the other rows, the process keeps its hyperparameters. All but stepwise need the extra `bench`. One thread is
used, so that times are those of one core.
"""

import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"
