"""When a soak is over, and what ends it otherwise; in virtual time."""

from dataclasses import replace

import pytest

from tumble.drivers.clock import VirtualClock
from tumble.drivers.errors import DeviceError
from tumble.drivers.protocols import EnvironmentStatus
from tumble.procedures.errors import StopRequestedError
from tumble.procedures.soaking import Seen, Soak, Soaking, still

SOAK = Soak(window_s=300.0, tolerance_k=0.5, rate_k_per_h=1.0, look_s=30.0, timeout_s=7200.0)


class FakeChamber:
    """Goes to its set point at 6 K a minute, at once where it is nearer."""

    limits_degc = (-40.0, 120.0)

    def __init__(self, clock, ramp_k_per_min=None):
        self.clock, self.ramp_k_per_min = clock, ramp_k_per_min
        self.told, self.air_degc, self.seen_s = [], 23.0, 0.0
        self.now = EnvironmentStatus(temperature_degc=23.0, setpoint_degc=23.0)

    def begin(self, setpoint_degc):
        self.told.append((round(self.clock.monotonic_s()), setpoint_degc))

    def status(self):
        elapsed_s, self.seen_s = self.clock.monotonic_s() - self.seen_s, self.clock.monotonic_s()
        if self.told and self.now.running:
            away_k = self.told[-1][1] - self.air_degc
            self.air_degc += max(-0.1 * elapsed_s, min(0.1 * elapsed_s, away_k))
        return replace(self.now, temperature_degc=self.air_degc)


def soaking(chamber, soak=SOAK, outputs=dict, check=lambda: None):
    return Soaking(chamber, "chamber", chamber.clock, soak, lambda: Seen(outputs_v=outputs()), check)


def test_it_is_over_once_nothing_has_moved_for_the_window():
    clock = VirtualClock()
    said = soaking(FakeChamber(clock)).carry_out(53.0)
    assert 600.0 <= clock.monotonic_s() <= 660.0  # 300 s on its way, 300 s of the window
    assert said == "53.00 °C after 10 min"


def test_the_set_point_goes_no_steeper_than_the_ramp():
    chamber = FakeChamber(VirtualClock(), ramp_k_per_min=2.0)
    soaking(chamber).carry_out(33.0)
    assert chamber.told[0] == (0, 24.0)
    assert max(after - before for (_, before), (_, after) in zip(chamber.told, chamber.told[1:], strict=False)) <= 1.0
    assert chamber.told[-1][1] == 33.0


def test_an_output_that_still_moves_keeps_it_going():
    clock = VirtualClock()

    def outputs():
        return {"u_x_v": 1e-4 * 2.0 ** (-clock.monotonic_s() / 600.0)}

    soaking(FakeChamber(clock), replace(SOAK, slope_v_per_h=1e-4), outputs).carry_out(24.0)
    assert clock.monotonic_s() > 900.0


def test_noise_of_an_output_does_not_keep_it_going():
    clock = VirtualClock()
    ripple = [1e-3, -2e-3, 2e-3, -1e-3, 0.0]

    def outputs():
        return {"u_x_v": ripple[round(clock.monotonic_s() / 30.0) % 5]}

    soaking(FakeChamber(clock), replace(SOAK, slope_v_per_h=1e-6), outputs).carry_out(24.0)
    assert clock.monotonic_s() < 600.0


def test_a_unit_that_is_not_there_yet_keeps_it_going():
    clock = VirtualClock()
    chamber = FakeChamber(clock)
    slow = soaking(chamber)
    slow.unit = lambda: Seen(temperatures_degc={"x": 25.0 - 2.0 * 2.0 ** (-clock.monotonic_s() / 400.0)})
    slow.carry_out(25.0)
    assert clock.monotonic_s() > 1200.0


def test_one_that_never_arrives_is_given_up():
    chamber = FakeChamber(VirtualClock())
    chamber.status = lambda: EnvironmentStatus(temperature_degc=23.0, setpoint_degc=60.0)
    with pytest.raises(DeviceError, match=r"has not come to rest at 60 °C in 12\d min; its air has 23.00 °C"):
        soaking(chamber).carry_out(60.0)


@pytest.mark.parametrize(("what", "said"), [("door_open", "its door is open"), ("alarm", "reports a fault of its own")])
def test_a_door_or_an_alarm_ends_it(what, said):
    chamber = FakeChamber(VirtualClock())
    chamber.now = replace(chamber.now, **{what: True})
    with pytest.raises(DeviceError, match=said):
        soaking(chamber).carry_out(30.0)


def test_one_that_lost_its_power_is_told_again():
    chamber = FakeChamber(VirtualClock())
    chamber.now = replace(chamber.now, running=False)

    def begin(setpoint_degc):
        chamber.told.append((0, setpoint_degc))
        chamber.now = replace(chamber.now, running=len(chamber.told) > 1)

    chamber.begin = begin
    soaking(chamber).carry_out(30.0)
    assert [degc for _, degc in chamber.told] == [30.0, 30.0]


def test_a_soak_can_be_stopped_at_once():
    chamber = FakeChamber(VirtualClock())

    def check():
        if chamber.clock.monotonic_s() > 100.0:
            raise StopRequestedError("stopped")

    with pytest.raises(StopRequestedError):
        soaking(chamber, check=check).carry_out(60.0)
    assert chamber.clock.monotonic_s() < 103.0


@pytest.mark.parametrize(("slope", "quiet"), [(0.9, True), (1.1, False)])
def test_a_straight_line_is_held_against_the_limit(slope, quiet):
    times_h = [0.0, 0.1, 0.2, 0.3]
    assert still(times_h, [slope * time_h for time_h in times_h], 1.0) is quiet
