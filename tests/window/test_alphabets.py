"""A scanner under another layout of the keyboard writes other letters, which is said before anything is measured."""

import pytest

from tumble.window.look.alphabets import doubt


@pytest.mark.parametrize(
    ("written", "meant"),
    [("ІТ-101", "SN-101"), ("фв1001", "ad1001"), ("ВЧД203УИ", "DXL203EB"), ("тгьиук 7", "number 7")],
)
def test_what_a_latin_scanner_writes_under_the_ukrainian_layout_is_told(qapp, written, meant):
    assert doubt(written) == f"In Cyrillic letters; with the keyboard on Latin ones it is {meant}."


@pytest.mark.parametrize("name", ["SN-101", "Блок 7", "Вузол-є", "Größe 3", "日本", "101", "", "😀-U1"])
def test_a_name_that_can_only_be_meant_so_is_not_doubted(qapp, name):
    assert doubt(name) == ""


def test_letters_that_look_alike_are_told_apart(qapp):
    assert doubt("\N{CYRILLIC CAPITAL LETTER ES}H-1") == (
        "Latin and Cyrillic letters in one name: \N{CYRILLIC CAPITAL LETTER ES} is Cyrillic."
    )


def test_it_is_said_below_the_form(lent_driver):
    form = lent_driver.run.form
    lent_driver.window.open(lent_driver.run)
    form.serial.setText("ІТ-101")  # no key of a test writes Cyrillic
    assert form.doubted.isVisible()
    assert "SN-101" in form.doubted.text()
    form.serial.clear()
    lent_driver.scan("SN-101")
    assert not form.doubted.isVisible()
