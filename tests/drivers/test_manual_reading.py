import pytest
from hypothesis import given
from hypothesis import strategies as st

from tumble.drivers.manual import format_dms, parse_reading

ANGLE_DEG = 12 + 34 / 60 + 56 / 3600


@pytest.mark.parametrize(
    "text",
    [
        "12°34′56″",
        "12° 34' 56\"",
        "12 34 56",
        "12:34:56",
        "12d34m56s",
        "12 deg 34 min 56 sec",
        "  +12 34 56 ",
        "12º34′56",
        "12° 34′ 56″\n",
    ],
)
def test_degrees_minutes_and_seconds_are_read_in_the_usual_writings(text):
    assert parse_reading(text) == pytest.approx(ANGLE_DEG, abs=1e-12)


@pytest.mark.parametrize(
    ("text", "angle_deg"),
    [
        ("50", 50.0),
        ("50°", 50.0),
        ("50.25", 50.25),
        ("50,25", 50.25),
        ("50 15", 50.25),
        ("50°15.5′", 50.0 + 15.5 / 60),
        ("50 15,5", 50.0 + 15.5 / 60),
        ("50:15:30,5", 50.0 + 15 / 60 + 30.5 / 3600),
        ("-0 30", -0.5),
        ("−12 34 56", -ANGLE_DEG),
        ("- 5", -5.0),
        ("395 0 0", 395.0),
    ],
)
def test_decimals_signs_and_shorter_writings_are_read(text, angle_deg):
    assert parse_reading(text) == pytest.approx(angle_deg, abs=1e-12)


@pytest.mark.parametrize(
    "text", ["", "abc", "12 34 56 78", "12..5", "--5", "5-", "12 60", "12 0 60", "1.5 30", "nan", "1e3"]
)
def test_what_is_no_angle_is_refused(text):
    with pytest.raises(ValueError, match=r"is no angle|fewer than 60|type it without"):
        parse_reading(text)


@given(st.integers(-1_000 * 36_000, 1_000 * 36_000))
def test_an_angle_that_was_written_is_read_as_itself(tenths):
    angle_deg = tenths / 36_000.0
    assert parse_reading(format_dms(angle_deg)) == pytest.approx(angle_deg, abs=1e-9)


@given(
    degrees=st.integers(0, 999),
    minutes=st.integers(0, 59),
    seconds=st.integers(0, 599),
    marks=st.sampled_from([("°", "′", "″"), (" ", " ", ""), (":", ":", ""), ("d", "m", "s"), ("deg ", "min ", " sec")]),
    decimal=st.sampled_from(".,"),
    sign=st.sampled_from(["", "+", "-", "−"]),
)
def test_any_marks_and_any_decimal_sign_give_the_same_angle(degrees, minutes, seconds, marks, decimal, sign):
    text = f"{sign}{degrees}{marks[0]}{minutes:02d}{marks[1]}{seconds // 10:02d}{decimal}{seconds % 10}{marks[2]}"
    size_deg = degrees + minutes / 60 + seconds / 36_000
    assert parse_reading(text) == pytest.approx(-size_deg if sign in ("-", "−") else size_deg, abs=1e-9)


@given(st.text(max_size=20))
def test_any_text_is_an_angle_or_refused_in_a_sentence(text):
    try:
        assert abs(parse_reading(text)) < 1e21
    except ValueError as error:
        assert "type" in str(error)


def test_an_angle_is_written_to_a_tenth_of_a_second_without_sixty():
    assert format_dms(59.99999999) == "60° 00′ 00″"
    assert format_dms(-12.5) == "-12° 30′ 00″"
    assert format_dms(0.00208333) == "0° 00′ 07.5″"
    assert format_dms(-1e-9) == "0° 00′ 00″"
