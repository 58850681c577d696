import pytest
from hypothesis import given
from hypothesis import strategies as st

from tumble.emulators.scpi.language import ScpiError, Tree, Unit, number, quoted, spellings, split, units, word

RANGE = "[SENSe]:VOLTage[:DC]:RANGe[:UPPer]"


def refused(number):
    return pytest.raises(ScpiError, match=f"^{number}")


@pytest.mark.parametrize(
    "header",
    [
        "SENS:VOLT:DC:RANG:UPP",
        "SENSE:VOLTAGE:DC:RANGE:UPPER",
        "VOLT:RANG",
        "VOLTAGE:RANG",
        "SENS:VOLT:RANGE",
        "VOLT:DC:RANG",
    ],
)
def test_a_header_is_found_by_any_of_its_spellings(header):
    assert Tree({RANGE: "range"}).find(header) == "range"


@pytest.mark.parametrize("header", ["VOLTA:RANG", "SENS:RANG", "VOLT", "RANG:VOLT", "VOLT:RANG?", "VOLT:AC:RANG", ""])
def test_a_header_is_not_found_by_anything_else(header):
    with refused(-113):
        Tree({RANGE: "range"}).find(header)


def test_a_query_is_another_entry():
    assert sorted(spellings("FETCh?")) == ["FETC?", "FETCH?"]
    assert list(spellings("*IDN?")) == ["*IDN?"]


def headers(message):
    return [unit.header for unit in units(message)]


def test_a_header_goes_on_where_the_one_before_it_ended():
    assert headers(":SENS:VOLT:RANG:AUTO 0;UPP 1") == ["SENS:VOLT:RANG:AUTO", "SENS:VOLT:RANG:UPP"]


def test_a_colon_goes_back_to_the_root():
    assert headers("trig:sour bus;:samp:coun 3;coun?") == ["TRIG:SOUR", "SAMP:COUN", "SAMP:COUN?"]


def test_a_common_command_leaves_the_path_as_it_is():
    assert headers("TRIG:SOUR IMM;*CLS;COUN 2") == ["TRIG:SOUR", "*CLS", "TRIG:COUN"]


def test_parameters_are_separated_by_commas_outside_quotation_marks_and_parentheses():
    (unit,) = units("CONF:TEMP FRTD , (@101,102), \"a,'b'\"")

    assert unit == Unit(header="CONF:TEMP", parameters=("FRTD", "(@101,102)", "\"a,'b'\""))


def test_nothing_between_semicolons_is_nothing():
    assert headers(";; *CLS ;") == ["*CLS"]


@pytest.mark.parametrize("message", ["1", "?", "VOLT 1;%", "é"])
def test_what_is_no_header_is_a_syntax_error(message):
    with refused(-102):
        list(units(message))


def test_an_open_quotation_is_refused():
    with refused(-151):
        split('DISP:TEXT "a', ";")


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1", 1.0),
        ("+1.5e-3", 0.0015),
        (".5", 0.5),
        ("100 mV", 0.1),
        ("100MV", 0.1),
        ("2V", 2.0),
        ("3 uV", 3e-6),
        ("1 kV", 1e3),
    ],
)
def test_a_number_may_have_a_suffix(text, value):
    assert number(text, "V") == pytest.approx(value)


@pytest.mark.parametrize(
    ("text", "unit", "error"),
    [("1.2.3", "V", -121), ("", "V", -121), ("5 s", "V", -131), ("5 xV", "V", -131), ("5 V", "", -138)],
)
def test_a_number_with_something_else_is_refused(text, unit, error):
    with refused(error):
        number(text, unit)


@pytest.mark.parametrize("text", ["imm", "IMM", "Immediate"])
def test_a_word_is_answered_in_its_short_form(text):
    assert word(text, ("BUS", "IMMediate")) == "IMM"


def test_half_a_word_is_none():
    with refused(-224):
        word("IMMED", ("BUS", "IMMediate"))


def test_text_stands_between_like_quotation_marks():
    assert quoted("'VOLT'") == "VOLT"
    with refused(-151):
        quoted("\"VOLT'")


@given(st.text(max_size=40))
def test_any_message_is_understood_or_refused(message):
    try:
        parsed = list(units(message))
    except ScpiError:
        return
    assert all(unit.header == unit.header.upper() for unit in parsed)
