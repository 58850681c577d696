"""What may go wrong with the frames of an emulated CAN DAQ; each fault hits the middle of a block."""

from collections.abc import Iterator

from tumble.drivers.candaq import DaqFrames
from tumble.emulators.faults import Fault

Entry = tuple[float, int, bytes]

LOST_FRAMES = 3


def spoilt(stream: Iterator[Entry], fault: Fault, frames: DaqFrames, epoch: int, middle: int) -> Iterator[Entry]:
    """The frames of a stream with a fault at the voltage frame number `middle`."""
    count = -1
    held: Entry | None = None
    for entry in stream:
        frame = frames.decode(entry[1], entry[2])
        voltage = frame is not None and frame.name == "Voltage"
        count += voltage
        if fault.kind == "frames_lost" and voltage and middle <= count < middle + LOST_FRAMES:
            continue
        if not (voltage and count == middle):
            yield entry
            if held is not None and voltage:
                yield held
                held = None
        elif fault.kind == "reorder":
            held = entry
        else:
            yield from _hit(entry, fault, frames, epoch, middle)
    if held is not None:
        yield held


def _hit(entry: Entry, fault: Fault, frames: DaqFrames, epoch: int, number: int) -> Iterator[Entry]:
    """What becomes of one voltage frame."""
    due_s, can_id, data = entry
    if fault.kind == "nan":
        yield due_s, *frames.encode_voltage(float("nan"), number, epoch)
    elif fault.kind == "overload":
        yield due_s, *frames.encode_voltage(float("inf"), number, epoch)
    elif fault.kind == "double":
        yield entry
        yield entry
    elif fault.kind == "cut":
        yield due_s, can_id, data[: len(data) // 2]
    elif fault.kind == "late":
        yield due_s + fault.lasts_s, can_id, data
    elif fault.kind == "garble":
        yield due_s, can_id, bytes([data[0] ^ 0x10]) + data[1:]
    else:
        yield due_s, can_id, data[:-1] + bytes([data[-1] ^ 0x01])
