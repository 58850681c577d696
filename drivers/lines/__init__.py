"""An instrument that tells numbers in lines of text, as many platforms, loggers and inclinometers do.

- `form`: what a line looks like, as a stand file declares it; `checksum`: what may stand at its end.
- `sampler`: samples from such lines; `declaration`: the table of a stand file.
"""
