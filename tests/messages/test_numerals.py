import pytest

from tumble.messages import AsWritten, Language, Message
from tumble.numerals import in_words_of, localised


@pytest.mark.parametrize(
    ("text", "german"),
    [
        ("1.01643(18) V/g", "1,01643(18) V/g"),
        ("0.5 to 1.5°", "0,5 bis 1,5°"),
        ("0° to 55°", "0° bis 55°"),
        ("-2.5e-07", "-2,5e-07"),
        ("it ends in 0.5.", "it ends in 0,5."),
        ("0.41 mV/run", "0,41 mV/Lauf"),
        ("2.03(37) °/turn", "2,03(37) °/Umdrehung"),
        ("0.62% of 25%.", "0,62\u00a0% of 25\u00a0%."),
    ],
)
def test_a_number_has_a_comma_and_a_range_a_word(text, german):
    assert localised(text, Language.GERMAN) == german


@pytest.mark.parametrize("name", ["0.2.0", "run-0.5.csv", "/data/0.5/a.csv", "27.11.2026", "bias_V", "v1.2"])
def test_versions_names_of_files_and_dates_stay_what_they_are(name):
    assert [localised(name, language) for language in Language] == [name] * 3


@pytest.mark.parametrize(
    "name",
    [
        "127.0.0.1",
        "127.0.0.1:5025",
        "/home/h/store",
        "/srv/s/min/V.toml",
        "~/h/stand.toml",
        "./h/s",
        "h/s.toml",
        "V.toml",
        "h.local",
        r"C:\h\s\min.toml",
        r"\\server\h\V",
        "file:///h/s",
        "TCPIP0::192.168.0.1::inst0::INSTR",
    ],
)
def test_paths_and_addresses_stay_what_they_are(name):
    assert [localised(f"{name}: 1 V", language) for language in Language] == [f"{name}: 1 {v}" for v in ("V", "В", "V")]


@pytest.mark.parametrize(
    "data",
    [
        "'ACME,7510,0.5'",
        "'sine 0.5 g 80 Hz'",
        "b'+0.5 V\\n'",
        '"it\'s 0.5 V"',
        "tumble control pause --at-most 0.5",
        "tumble run --serial SN-0.5",
        "SN-0.5",
    ],
)
def test_what_was_typed_or_answered_stays_what_it_is(data):
    assert [localised(f"{data}, 0.5 s", language) for language in Language] == [
        f"{data}, {time}" for time in ("0.5 s", "0,5 с", "0,5 s")
    ]


def test_an_apostrophe_quotes_nothing():
    assert localised("the stand's 0.5 V and the unit's 1.5 V", Language.GERMAN) == (
        "the stand's 0,5 V and the unit's 1,5 V"
    )


def test_a_rate_is_no_path():
    assert localised("0.5 mV/h, 1.5 V/(g h), V/s", Language.UKRAINIAN) == "0,5 мВ/год, 1,5 В/(g год), В/с"
    assert localised("8.8(1) °/h, 3 ″/h, (°/h²)", Language.UKRAINIAN) == "8,8(1) °/год, 3 ″/год, (°/год²)"


def test_units_are_cyrillic_in_ukrainian():
    assert localised("0.5 to 2.5 mV after 3 s", Language.UKRAINIAN) == "0,5 … 2,5 мВ after 3 с"


def test_english_is_left_alone():
    assert localised("0.5 to 2.5 mV", Language.ENGLISH) == "0.5 to 2.5 mV"


def test_what_is_written_in_a_message_stays_as_it_is():
    told = Message(
        "{unit} of lot {lot} reads {value} V", unit=AsWritten("SN 1.5"), lot=AsWritten("26.3"), value="26.31"
    )
    both = Message.joined(", ", (told, "50%"))
    assert in_words_of(both, Language.GERMAN) == "SN 1.5 of lot 26.3 reads 26,31 V, 50\u00a0%"
