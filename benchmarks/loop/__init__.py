"""Grades `close_loop` on the bank: does it name what is there, invent nothing, and state true parameters?

    python -m benchmarks.loop MEASURE [--seeds development|reported] [--count N] [--workers 2] [--out results.jsonl]

- `exactness`: is every table traced to what was put in, and are the rivals those of an independent refit?
- `clean`: how often is an effect found where there is none?
- `coverage`: do the stated intervals hold the true parameters, and how much of the error is gone?
- `sparse`: what is stated of tables with too few settings to tell anything?
- `timing`: how long does it take?

With `--out` every graded table becomes a line of that file at once, and tables that are in it already are not made
again: a run that was interrupted continues. Every process uses one thread, so that times are those of one core.
"""

import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"
