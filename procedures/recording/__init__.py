"""Recordings: the journal of a run, and the raw data of a calibration (MCAP).

- `header.Header`: what a recording says of itself.
- `writer.Recorder`: writes events while a run goes on; what was completed is on the disk.
- `reader.read_recording`, `reader.iter_samples`: read a recording, whole or cut off.
- `endings.warnings`: what is to be said of one that is not whole.
- `errors.RecordingError`: what goes wrong with files.
- `schemas`: topics and fields of the messages.

Nothing is imported here, so that `header` and `errors` come without the MCAP library.
"""
