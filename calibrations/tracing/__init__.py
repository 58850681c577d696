"""Closing the loop: from what the declared model leaves to named effects, and back to better parameters.

- `loop.close_loop`: the whole of it for one table; `document.document`: the same as JSON (`tumble.loop/1`).
- `questions`, `seats`: what to ask before anything is explained.
- `table`, `sample`, `footing`: any table, ready for comparison in white noise and in noise that remembers (`noise`);
  `ground`: that of an accelerometer.
- `candidates`, `problem`, `search`, `fitting_noise`, `trace`: how a residual is traced.
- `evidence`: on how many blocks an effect rests, and whether it holds in them; `judged`: what stands, and what is
  withheld; `reach`: what so many settings can show; `realisations`: what is a pass; `still`: a table of one pose.
- `rivals`: which other effects would explain it as well; `prediction`, `separation`, `probes`, `experiments`: what
  would part them.
- `quantified`, `findings`: what was found, as numbers and as reported; `linear`, `linear_loop`: for a model that is
  linear in its parameters.
- `augmented`: the declared model with what was found; `taken_back`: what it cannot tell after all; `misreading`: gross
  errors by a round amount; `held_out`: the error on rows that did not choose it; `words`: all of it in sentences.
"""
