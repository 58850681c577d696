"""What is measured now, whichever way it was begun: the form, folded to a line."""

from PySide6.QtWidgets import QWidget

from tumble.app.running import Job
from tumble.procedures.plan import Plan
from tumble.window.look.plain import PlainLabel
from tumble.window.look.sentences import lot_text, plan_text


class RunLine(PlainLabel):
    """Unit, lot, programme, operator, and what the programme takes, of the run that runs."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent=parent)
        self.setObjectName("heading")
        self.setWordWrap(True)
        self.hide()

    def show_run(self, job: Job, plan: Plan) -> None:
        """Show another run."""
        parts = (job.serial_number, lot_text(job.lot), job.programme.name, job.operator, plan_text(plan))
        self.setText(" · ".join(filter(None, parts)))
