"""The instruments of a stand file, as a certificate names them."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from datetime import date
from typing import Any, Final

from tumble.calibrations.report.dates import day_of
from tumble.messages import Message

_SINGLE: Final = {
    "head": Message("dividing head"),
    "daq": Message("DAQ"),
    "exciter": Message("exciter"),
    "chamber": Message("temperature chamber"),
}
_NAMED: Final = ("positioners", "samplers")
"""Tables of the stand file that hold instruments by names of their own."""


@dataclass(frozen=True, kw_only=True)
class Instrument:
    """One instrument with the certificate that its readings are traced by. Texts are empty where none is stated."""

    name: str
    driver: str
    serial: str
    certificate: str
    due: str
    """ISO 8601; by when it is to be calibrated again."""

    def overdue(self, on: date) -> bool:
        """Whether that day was past on another; on the day itself its calibration still holds."""
        due = day_of(self.due)
        return due is not None and due < on


def instruments(stand: Mapping[str, Any]) -> Iterator[Instrument]:
    """Those of a stand file, in its order."""
    for name, title in _SINGLE.items():
        if isinstance(table := stand.get(name), Mapping):
            yield _instrument(title, table)
    for group in _NAMED:
        for name, table in (stand.get(group) or {}).items():
            yield _instrument(name, table)


def laboratory(stand: Mapping[str, Any]) -> tuple[str, str]:
    """Name and address as the stand file states them; empty where it does not."""
    table = stand.get("laboratory") or {}
    return str(table.get("name", "")), str(table.get("address", ""))


def _instrument(name: str, table: Mapping[str, Any]) -> Instrument:
    driver, serial, certificate, due = (
        str(table.get(key) or "") for key in ("driver", "serial", "certificate", "calibration_due")
    )
    return Instrument(name=name, driver=driver, serial=serial, certificate=certificate, due=due)
