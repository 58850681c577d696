"""What a report quotes of files and programs is the same in every language."""

import pytest

from tumble.calibrations.core.provenance import Provenance, Source
from tumble.calibrations.report.language import say, written_in
from tumble.calibrations.report.origin import origin_sections
from tumble.messages import Language

LOOKS_LIKE_QUANTITIES = Provenance(
    serial_number="SN-0.5",
    programme_name="warm 1.5 h",
    stand_name="bench 2.5 s",
    stand={"head": {"accuracy_arcsec": 0.25}, "output": {"unit": "V"}},
    sources=(Source(kind="table", path="at 3.5 V.csv", sha256="ab" * 32),),
    program_version="0.5",
    packages={"pyserial": "3.6"},
)


@pytest.mark.parametrize("language", [Language.GERMAN, Language.UKRAINIAN])
def test_names_versions_and_the_stand_file_are_quoted_as_they_are(language):
    with written_in(language):
        shown = [
            say(cell) for section in origin_sections(LOOKS_LIKE_QUANTITIES) for row in section.rows for cell in row
        ]

    assert {"at 3.5 V.csv", "warm 1.5 h", "bench 2.5 s", "0.25", "V", "0.5", "3.6"} <= set(shown)
