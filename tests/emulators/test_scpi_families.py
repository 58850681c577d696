"""What tells the emulated meters apart, as their manuals have it."""

import pytest
from scpi_bench import emulated

from tumble.drivers.errors import NoReplyError
from tumble.drivers.simulated import Simulated

QUIET = Simulated(noise_v=0.0)


class Talk:
    """Ask in virtual time."""

    def __init__(self, model, messages=None):
        self.link, self.clock = emulated(QUIET, model=model, messages=messages)

    def say(self, *messages):
        for message in messages:
            self.link.write(message.encode() + b"\n")

    def ask(self, message, wait_s=100.0):
        self.say(message)
        return self.link.read_line(b"\n", wait_s).decode().strip()

    def error(self):
        return int(self.ask("SYST:ERR?").split(",")[0])


def test_one_meter_answers_the_first_query_of_a_message_alone():
    talk = Talk("34461A", "first")

    assert talk.ask("*ESE 5;*ESE?;*STB?") == "+5"
    assert talk.error() == -410


def test_another_answers_none_of_them():
    talk = Talk("34461A", "one")
    with pytest.raises(NoReplyError):
        talk.ask("*ESE 5;*ESE?;*STB?", 1.0)

    assert talk.error() == -113
    assert talk.ask("*ESE?") == "+0"


def test_a_third_answers_in_lines_of_their_own():
    assert Talk("34461A", "lines").ask("*ESE 5;*ESE?;*ESE?") == "+5"


def test_the_buffer_of_a_keithley_2000_fills_once_and_stays():
    talk = Talk("MODEL 2000")
    talk.say("TRAC:CLE", "TRAC:POIN 3", "TRAC:FEED SENS", "TRAC:FEED:CONT NEXT", "TRIG:COUN 3", "INIT")

    readings = talk.ask("TRAC:DATA?")

    assert readings.count(",") == 2
    assert talk.ask("TRAC:DATA?") == readings
    assert talk.ask("TRAC:FEED:CONT?") == "NEV"
    assert talk.error() == 0


def test_an_empty_buffer_is_an_error():
    talk = Talk("MODEL 2000")
    talk.say("TRAC:CLE", "TRAC:DATA?")

    assert talk.error() == -230


def test_a_keithley_2000_hears_nothing_while_it_measures():
    talk = Talk("MODEL 2000")
    talk.say("VOLT:NPLC 0.1", "TRIG:SOUR TIM", "TRIG:TIM 0.1", "TRIG:COUN 20", "INIT")
    began_s = talk.clock.monotonic_s()

    assert talk.ask("*ESE?") == "+0"
    assert talk.clock.monotonic_s() - began_s == pytest.approx(2.0, abs=0.2)


def test_only_abort_reaches_it():
    talk = Talk("MODEL 2000")
    talk.say("TRIG:SOUR TIM", "TRIG:TIM 0.1", "TRIG:COUN 20", "INIT", "ABOR")
    began_s = talk.clock.monotonic_s()

    talk.ask("*ESE?")

    assert talk.clock.monotonic_s() - began_s < 0.2


def test_a_dmm6500_fills_its_buffer_by_a_loop():
    talk = Talk("MODEL DMM6500")
    talk.say(
        'SENS:FUNC "VOLT:DC"', 'TRAC:CLE "defbuffer1"', 'TRIG:LOAD "SimpleLoop",4,0.05,"defbuffer1"', "INIT", "*WAI"
    )

    assert talk.ask('TRAC:DATA? 2,4,"defbuffer1",READ').count(",") == 2
    assert talk.ask('TRAC:ACT? "defbuffer1"') == "4"
    assert talk.ask("SYST:ERR?") == '0,"No error;0;0 0"'


def test_a_siglent_gives_readings_as_often_as_fetched_and_once_by_r():
    talk = Talk("SDM3065X")
    talk.say("CONF:VOLT:DC 20", "TRIG:COUN 2", "INIT")

    fetched = talk.ask("FETC?")

    assert talk.ask("FETC?") == fetched
    assert talk.ask("R? 2") == f"#2{len(fetched)}{fetched}"
    assert talk.ask("R?") == "#10"


def test_a_siglent_takes_no_settings_while_it_measures():
    talk = Talk("SDM3065X")
    talk.say("TRIG:COUN 100", "INIT", "VOLT:DC:NPLC 1")

    assert talk.error() == -221


def test_a_rigol_speaks_its_own_language_until_told_otherwise():
    talk = Talk("DM3058")
    talk.say("CONF:VOLT:DC")
    assert talk.error() == -113

    talk.say("CMDSET AGILENT", "CONF:VOLT:DC")

    assert talk.ask("CMDSET?") == "AGILENT"
    assert talk.error() == 0


def test_a_rigol_keeps_only_bits_that_mean_something():
    talk = Talk("DM3058")
    talk.say("*ESE 255")

    assert talk.ask("*ESE?") == "+189"


@pytest.mark.parametrize(
    ("model", "command"),
    [
        ("MODEL 2000", "SAMP:TIM 0.1"),
        ("MODEL DMM6500", "CONF:VOLT:DC"),
        ("SDM3065X", "VOLT:DC:ZERO:AUTO 0"),
        ("DM3068", "SYST:LFR?"),
        ("PLAIN-5", "FUNC?"),
        ("READ-ONCE", "INIT"),
    ],
)
def test_what_a_manual_does_not_list_is_not_known(model, command):
    talk = Talk(model)
    talk.say("CMDSET AGILENT", "*CLS", command)

    assert talk.error() == -113
