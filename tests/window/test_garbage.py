"""Widgets belong to the thread of the event loop: no other may destroy them."""

import threading


class Ring:
    """Something that only the search for cycles can free, and that tells where that was."""

    def __init__(self, freed):
        self.myself = self
        self.freed = freed

    def __del__(self):
        self.freed.append(threading.current_thread())


def test_garbage_is_freed_in_the_thread_of_the_window_though_another_computes(driver):
    freed, computed = [], []
    Ring(freed)

    busy = threading.Thread(target=lambda: computed.extend([] for _ in range(100_000)))
    busy.start()
    busy.join()
    driver.wait(lambda: freed)

    assert freed == [threading.main_thread()]
