"""Somebody who stops while an instrument is awaited."""

import time


class StoppedError(Exception):
    """Somebody stops."""


class Stop:
    """Raises once it was called three times, and notes when."""

    def __init__(self):
        self.moments_s = [time.monotonic()]

    def __call__(self):
        self.moments_s.append(time.monotonic())
        if len(self.moments_s) > 3:
            raise StoppedError
