"""A head measured against a reference: rests, ramps and constant speed, traced as any other table is.

- `rows`: the rows as dwells, and how far the reference stands from the head, wrapped or not.
- `scene`: what an effect may depend on; `effects`: the catalogue; `shapes`: structure without a name.
- `loop.close_reference_loop`: the whole of it for one table.
"""
