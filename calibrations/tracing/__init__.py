"""Closing the loop: from what a declared model leaves to named effects, and back to better parameters.

It knows no method: a method declares its table, its effects and its probes.

- `effect`, `declared`, `table`, `probe`: what a method declares.
- `sample`, `whitened`: any table, ready for comparison in white and in autocorrelated noise (`noise`).
- `candidates`, `problem`, `search`, `fitting_noise`, `trace`: how a residual is traced.
- `evidence`: on how many blocks an effect rests, and whether it holds in them; `judged`: what stands, and what is
  withheld; `held_out`: the error on rows that did not choose it.
- `rivals`: which other effects would explain it as well; `prediction`, `separation`, `experiments`: what would part
  them; `chain`: experiments one after the other.
- `quantified`, `findings`, `document`, `sentences`: what was found, as numbers, as reported, as JSON and in words.
- `linear`, `linear_loop`, `within`: for a model that is linear in its parameters.
"""
