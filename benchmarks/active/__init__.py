"""Does the loop find out what it cannot tell? On the simulated stand, with units, heads and seats drawn at random.

    python -m benchmarks.active [--seeds development|reported] [--count 160] [--workers 2] [--out results.jsonl]

Every case is one unit with one effect, a first programme that may leave it ambiguous, and a stand that may not be
able to run every experiment. From the truth alone (`oracle.py`) it follows which cases the first programme shows and
may leave open: the loop is closed on these. Cases that it tells by the first programme are no cases. For the others
the truth says, too, what the experiments of the stand could tell, six runs at most: where every rival would come out
behind in 95 of 100 noises, the loop must find the right name without a rival; where one would stay beside it in 95 of
100, the loop must say that nothing available tells them apart. Between, the noise decides, and either will do.

With `--unnamed` the effects are outside the catalogue, and what is asked is channel and variable. What can be located
is found without the planner: the loop did it, or on two further copies of the stand every experiment that it can run
is run and everything is traced together.

A third of the other cases have their effect in a physics file, `response` or `head_error`, in formulas of their own.
"""

import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"
