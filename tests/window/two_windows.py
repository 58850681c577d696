"""The queue of one store as several windows have it."""

from tumble.window.work.run_queue import Entry


def entry(serial_number="A-1", stand="", programme="quick"):
    return Entry(serial_number=serial_number, programme=str(programme), stand=stand)


def add(queue, *serial_numbers):
    """Add an entry for each unit; returns their ids."""
    entries = [entry(serial_number) for serial_number in serial_numbers]
    queue.update(lambda each: each.add(*entries))
    return [each.id for each in entries]


def stages(queue):
    return [(each.serial_number, each.stage) for each in queue.queue.entries]
