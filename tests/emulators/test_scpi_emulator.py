import pytest
from hypothesis import given
from hypothesis import strategies as st
from scpi_bench import emulated

from tumble.drivers.errors import NoReplyError
from tumble.drivers.simulated import Simulated

QUIET = Simulated(noise_v=0.0)


class Talk:
    """Ask in virtual time."""

    def __init__(self, **options):
        self.link, self.clock = emulated(QUIET, **options)

    def say(self, message):
        self.link.write(message.encode() + b"\n")

    def ask(self, message):
        self.say(message)
        return self.link.read_line(b"\n", 100.0).decode().strip()

    def errors(self):
        found = []
        while (entry := self.ask("SYST:ERR?")) != '+0,"No error"':
            found.append(int(entry.split(",")[0]))
        return found


@pytest.fixture
def talk():
    return Talk()


def test_the_answers_to_one_message_come_in_one_line(talk):
    assert talk.ask("*ESE 5;*ESE?;:SYST:VERS?;*ESE?") == "+5;1994.0;+5"


def test_an_unknown_header_ends_the_message(talk):
    assert talk.ask("*ESE?;FOO;*STB?") == "+0"
    assert talk.errors() == [-113]


def test_what_cannot_be_done_does_not_end_the_message(talk):
    assert talk.ask("SAMP:COUN 0;COUN?") == "+1"
    assert talk.errors() == [-222]


@pytest.mark.parametrize(
    ("message", "error"),
    [
        ("READ? 3", -108),
        ("*ESE", -109),
        ("*ESE 256", -222),
        ("SAMP:COUN x", -224),
        ("VOLT:RANG 5 s", -131),
        ("SAMP:COUN 5 V", -138),
        ("SENS:FUNC VOLT", -151),
        ('SENS:FUNC "CURR"', -224),
        ("FETC?", -230),
        ("*TRG", -211),
        ("TRIG:SOUR BUS;:READ?", -214),
        ("TRIG:SOUR EXT;:INIT;:FETC?", -214),
        ("INIT;INIT", -213),
        ("CONF:VOLT 5000", -222),
        ("CONF:VOLT 10,1e-9", -222),
        ("*IDN?;*ESE?", -440),
        ("READ?\nREAD?", -410),
    ],
)
def test_the_error_queue_says_what_is_wrong(talk, message, error):
    talk.say(message)
    talk.link.discard_input()

    assert error in talk.errors()


def test_a_full_error_queue_says_so_last(talk):
    for _ in range(30):
        talk.say("FOO")

    assert talk.errors() == [-113] * 19 + [-350]


def test_the_event_register_knows_the_kinds_of_errors_and_forgets_when_read(talk):
    assert talk.ask("*ESR?") == "+128"
    talk.say("FOO")
    talk.say("SAMP:COUN 0")
    talk.say("*OPC")

    assert talk.ask("*ESR?") == "+49"
    assert talk.ask("*ESR?") == "+0"


def test_the_status_byte_sums_up(talk):
    talk.say("*CLS;*ESE 32;FOO")

    assert talk.ask("*STB?") == "+36"


@pytest.mark.parametrize(
    ("set_", "query", "answer"),
    [
        ("VOLT:RANG 3", "VOLT:RANG?;RANG:AUTO?", "+1.00000000E+01;0"),
        ("VOLT:RANG:AUTO ON", "SENSE:VOLTAGE:DC:RANGE:AUTO?", "1"),
        ("VOLT:RANG MIN", "VOLT:RANG?", "+1.00000000E-01"),
        ("VOLT:NPLC 5", "VOLT:NPLC?", "+1.00000000E+01"),
        ("VOLT:APER 0.1", "VOLT:APER:ENAB?", "1"),
        ("VOLT:APER 0.1;NPLC 1", "VOLT:APER:ENAB?", "0"),
        ("VOLT:RANG 10;RES 1e-4", "VOLT:NPLC?", "+2.00000000E-01"),
        ("VOLT:RES MIN", "VOLT:NPLC?", "+1.00000000E+02"),
        ("VOLT:ZERO:AUTO ONCE", "VOLT:ZERO:AUTO?", "0"),
        ("TRIG:DEL 0.5", "TRIG:DEL?;DEL:AUTO?", "+5.00000000E-01;0"),
        ("TRIG:COUN INF", "TRIG:COUN?", "+9.90000000E+37"),
        ("TRIG:SOUR immediate", "TRIG:SOUR?", "IMM"),
        ("SAMP:COUN 12.4", "SAMP:COUN?;COUN? MAX", "+12;+1000000"),
        ("VOLT:NPLC 1", "SAMP:TIM? MIN", "+4.00000000E-02"),
        ('DISP:TEXT "a;b"', "DISP:TEXT?", '"a;b"'),
        ('DISP:TEXT "a";TEXT:CLE', "DISP:TEXT?", '""'),
        ('FUNC "TEMPERATURE"', "FUNC?;:CONF?", '"TEMP";"TEMP"'),
        ("CONF:VOLT 1,1e-6", "CONF?", '"VOLT +1.00000000E+00,+1.00000000E-06"'),
        ("VOLT:RANG 100;*RST", "VOLT:RANG?", "+1.00000000E+01"),
        ("SAMP:COUN 5;:CONF:VOLT:DC", "SAMP:COUN?", "+1"),
        ("SYST:REM;:SYST:LOC;BEEP", "ROUT:TERM?", "FRON"),
        ("*WAI", "*OPT?", "0"),
        ("*LANG SCPI", "*LANG?;:SYST:LIC:CAT?", 'SCPI;""'),
    ],
)
def test_a_setting_is_answered_as_it_was_set(talk, set_, query, answer):
    talk.say(set_)

    assert talk.ask(query) == answer
    assert talk.errors() == []


def test_a_measurement_takes_its_time(talk):
    began_s = talk.clock.monotonic_s()

    talk.ask("CONF:VOLT:DC;:VOLT:NPLC 100;:SAMP:COUN 3;:READ?")

    assert talk.clock.monotonic_s() - began_s == pytest.approx(3 * 2 * 100 / 50, abs=0.1)


def test_an_answer_is_not_given_before_the_last_reading_is_there(talk):
    talk.say("READ?")

    assert talk.link.session.due() == b""
    talk.clock.sleep(0.5)
    assert talk.link.session.due().startswith(b"+2.")


def test_operation_complete_waits_for_the_readings(talk):
    talk.say("VOLT:NPLC 100;:INIT")
    began_s = talk.clock.monotonic_s()

    assert talk.ask("*OPC?") == "1"
    assert talk.clock.monotonic_s() - began_s == pytest.approx(4.0, abs=0.1)


def test_readings_can_be_fetched_as_often_as_one_likes(talk):
    assert len(set(talk.ask("SAMP:COUN 2;:INIT;:FETC?;FETC?").split(";"))) == 1


def test_a_trigger_from_the_bus_begins_what_was_initiated(talk):
    talk.say("TRIG:SOUR BUS;:SAMP:COUN 4;:INIT;*TRG")

    assert len(talk.ask("FETC?").split(",")) == 4


def test_an_abort_ends_a_measurement_without_readings(talk):
    talk.say("INIT;:ABOR;:FETC?")

    assert talk.errors() == [-230]


def test_an_interrupted_query_is_never_answered(talk):
    talk.say("READ?")

    assert talk.ask("*ESE?") == "+0"
    with pytest.raises(NoReplyError):
        talk.link.read_line(b"\n", 10.0)
    assert talk.errors() == [-410]


def test_voltage_out_of_range_is_an_overload(talk):
    assert talk.ask("MEAS:VOLT:DC? 1") == "+9.90000000E+37"


def test_the_thermometer_is_read_on_request(talk):
    assert float(talk.ask("MEAS:TEMP? FRTD")) == pytest.approx(23.0, abs=0.5)


@pytest.mark.parametrize(("model", "function"), [("34461A", '"VOLT"'), ("MODEL DMM6500", '"VOLT:DC"')])
def test_a_model_has_its_own_name_for_dc_voltage(model, function):
    talk = Talk(model=model)
    talk.say('FUNC "VOLT:DC"')

    assert talk.ask("FUNC?") == function


@given(st.text(st.characters(codec="latin-1", exclude_characters="\n"), max_size=60))
def test_whatever_is_said_it_goes_on_answering(message):
    talk = Talk()
    talk.link.session.received(message.encode("latin-1") + b"\n")

    assert talk.ask("*CLS;*ESE?").startswith("+")
