"""Stand records: what belongs to the stand, found on several units, kept, and applied to later runs.

- `head_map.HeadMap`: the error of a head as harmonics and backlash, with its covariance.
- `corrections.Corrections`: everything that a stand adds to a measurement, head map included, with one covariance.
- `evidence`: what one run says of its stand; `agreement`: whether two runs say the same, and what they say together.
- `applying.corrected`: rows of a later run with the corrections applied; `contradiction`: what the loop still finds.
- `record.StandRecord`: one record; `store.StandRecords`: those of a folder.
"""
