"""A triad on a stand with two axes: its positions, its columns, and the table of a recording.

- `layout`: the columns of a dwell; `positions`: lists of positions; `programme`: lists, orders, temperatures.
- `observations`: a recording as the table that the analysis reads.
- `method`: what registers it.
"""
