"""On paper no unit is torn from its number, however narrow the cell is."""

import json

import pytest
import typst

from tumble.calibrations.report import paper

EMPTY = {
    "language": "en",
    "labels": {"page": "{page} {pages}"},
    "kind": "Report",
    "title": "SN-1",
    "front": None,
    "notices": [],
    "chapters": [],
}
LINE = 1.8357
"""From one line to the next, in heights of an x, as the template sets them."""


def lines(text):
    """Of how many lines a text is that has no room at all."""
    asked = (
        f"#let high(body) = measure(block(width: 1pt, body)).height\n#context [#metadata(high[{text}] / high[x])<high>]"
    )
    source = paper._TEMPLATE.read_text("utf-8") + asked
    found = typst.query(source.encode(), "<high>", ignore_system_fonts=True, sys_inputs={"report": json.dumps(EMPTY)})
    (high,) = [each["value"] for each in (json.loads(found) if isinstance(found, str) else found)]
    return 1 + round((high - 1) / LINE)


@pytest.mark.parametrize(
    "text", ["12 V", "1,2 мкВ/g²", "0.5 °/h", "20 s.", "5 ppm/K", "3 mV/g,", "10.11(38) µV/(m/s²)²"]
)
def test_number_and_unit_stay_on_one_line(text):
    assert lines(text) == 1


@pytest.mark.parametrize(
    ("text", "count"),
    [
        ("(999.94 ± 0.15) mV/g", 3),
        ("3 of 4", 3),
        ("12 samples", 2),
        ("4 steps", 2),
        ("0.95 V to 1.05 V", 3),
        ("1 mV/g 2 °C 3 % 4 g₀ 5 °", 5),
    ],
)
def test_everything_else_breaks_as_before(text, count):
    assert lines(text) == count
