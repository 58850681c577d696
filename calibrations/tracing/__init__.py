"""Closing the loop: from what the declared model leaves to named effects, and back to better parameters.

- `loop.close_loop`: the whole of it for one table; `document.document`: the same as JSON (`tumble.loop/1`).
- `questions`: what to ask before anything is explained.
- `ground`, `candidates`, `problem`, `search`, `noise`, `trace`: how a residual is traced.
- `rivals`: which other effects would explain it as well; `experiments`: what would part them.
- `augmented`: the declared model with what was found; `misreading`: gross errors by a round amount.
"""
