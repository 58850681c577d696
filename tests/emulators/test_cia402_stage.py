import pytest
from canopen.profiles.p402 import State402
from hypothesis import given
from hypothesis import strategies as st

from tumble.drivers.cia402.states import State
from tumble.emulators.cia402_stage import PowerStage

STATES = {state.value.upper(): state for state in State}
COMMANDED = {pair: code for pair, code in State402.TRANSITIONTABLE.items() if code}


@pytest.mark.parametrize(("start", "end"), COMMANDED)
def test_every_commanded_transition_of_the_profile_is_made(start: str, end: str):
    stage = PowerStage()
    stage.state = STATES[start]
    word = COMMANDED[start, end]
    stage.command(word, rising=word)
    assert stage.state is STATES[end]


def test_a_fault_is_left_only_at_the_rising_edge_of_the_reset_bit():
    stage = PowerStage()
    stage.fail()
    for word, rising in ((0x0F, 0x0F), (0x80, 0x00)):
        stage.command(word, rising)
        assert stage.state is State.FAULT
    stage.command(0x80, 0x80)
    assert stage.state is State.SWITCH_ON_DISABLED


@given(st.lists(st.integers(0, 0xFFFF), max_size=30))
def test_a_drive_is_enabled_only_from_ready_on(words: list[int]):
    stage, before = PowerStage(), State.SWITCH_ON_DISABLED
    for word in words:
        stage.command(word, rising=word)
        if stage.state is State.ENABLED:
            assert before is not State.SWITCH_ON_DISABLED
        before = stage.state
