"""Numbers of both models beside each other, and once where they are the same."""

from tumble.calibrations.tracing.loop_sections import beside_each_other


def test_where_the_models_differ_both_stand_in_the_table():
    headings, rows = beside_each_other(("Parameter",), [("kx", "1.0", "1.1"), ("ky", "0", "0")])
    assert headings == ("Parameter", "Declared model", "With what was found")
    assert rows == [("kx", "1.0", "1.1"), ("ky", "0", "0")]


def test_where_nothing_was_found_nothing_stands_twice():
    headings, rows = beside_each_other(("", "dwells"), [("kx", "2", "1.0", "1.0"), ("ky", "3", "0", "0")])
    assert headings == ("", "dwells", "Declared model")
    assert rows == [("kx", "2", "1.0"), ("ky", "3", "0")]
