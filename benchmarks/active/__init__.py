"""Does the loop find out what it cannot tell? On the simulated stand, with units, heads and seats drawn at random.

    python -m benchmarks.active [--seeds development|reported] [--count 160] [--workers 2] [--out results.jsonl]

Every case is one unit with one effect, a first programme that may leave it ambiguous, and a stand that may not be able
to run every experiment. Cases that the first programme tells by itself are no cases. Of the others, what can be told is
found without the planner: the loop told it, or on two further copies of the stand, of different noise, every experiment
that it can run is run and everything is traced together. Where both leave one name, some available experiment parts the
rivals, and the loop must find the right name without a rival; where both leave several, the loop must say that nothing
available tells them apart. Where only one of the two tells, the noise decides, and nothing is asked.

With `--unnamed` the effects are outside the catalogue, and what is asked is channel and variable.

A third of the other cases have their effect in a physics file, `response` or `head_error`, in formulas of their own.
"""

import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"
