"""Adopted effects: structure without a name that was found on units, given a name, kept, and sought on later runs.

- `knots.Knots`: the variable of an effect, cut into knots; `curve.Curve`: its course over them, with its covariance.
- `seen.seen`: what one run says of such a course; `shared.shared`: what several say together, and how units differ.
- `effect.AdoptedEffect`: one effect as it is kept; `document`: as JSON; `folder.Folder`: the files of a folder.
- `offered.offered`: the same as an effect of the catalogue; `contradicting.contradictions`: where a run disagrees.
"""
