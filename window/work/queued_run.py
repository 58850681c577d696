"""The run of an entry of the queue, at the stand that is on screen."""

from tumble.app.running import Job
from tumble.app.stand import LoadedStand
from tumble.procedures.plan import Plan
from tumble.procedures.programmes import load_programme
from tumble.procedures.steps import Dwell
from tumble.window.work.run_queue import Entry


def planned(entry: Entry, stand: LoadedStand) -> tuple[Job, Plan]:
    """What is to be run, and its plan. Raises `InputError` where it does not fit the stand."""
    programme = load_programme(entry.programme)
    job = Job(
        stand=stand,
        programme=programme,
        serial_number=entry.serial_number,
        lot=entry.lot,
        operator=entry.operator,
    )
    return job, job.plan()


def place_of(stand: LoadedStand) -> str:
    """By what entries know their stand: the path of its file; empty for one that is built in."""
    return str(stand.path.resolve()) if stand.path else ""


def asks_first(plan: Plan) -> bool:
    """Whether the person sets something before the first dwell, and so is shown the unit that is meant."""
    before = (planned.by_hand for planned in plan.steps)
    dwells = (isinstance(planned.step, Dwell) for planned in plan.steps)
    return next((asked for asked, dwell in zip(before, dwells, strict=True) if asked or dwell), False)
