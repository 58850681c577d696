from PySide6.QtCore import Qt
from window_driver import STAND

from tumble.app import (
    analysing,
    recall,  # noqa: F401  # takes these names from `analysing` once and for all, and must not take the patched ones
)
from tumble.procedures.programmes import load_programme
from tumble.procedures.recording.reader import read_recording
from tumble.window.work.records import open_record

CUBIC = STAND.replace('preset = "DXL203EB"', 'preset = "DXL203EB"\nnoise_v = 2e-5\neffects = { k_xxx = 5e-4 }')
SWEEPS = """\
name = "sweeps"
realisations = 3
dwell_s = 0.1
settle_s = 0.0

[[procedure]]
kind = "sweep"
step_deg = 15.0
points = 24

[[procedure]]
kind = "sweep"
mount = "face-down"
step_deg = 15.0
points = 24
"""

PROBE = """\
name = "probe-face-up-90"
dwell_s = 0.1
settle_s = 0.0

[[procedure]]
kind = "sweep"
mount = "face-up-90"
step_deg = 15.0
points = 24
"""
"""A tenth of the probe that comes along: less to analyse."""


def test_the_closed_loop_asks_for_an_experiment_that_a_key_runs(driver, write, monkeypatch, no_report):
    probes = {"probe-face-up-90": write("probe.toml", PROBE)}
    driver.window.stand.open(write("cubic.toml", CUBIC))
    driver.start(write("sweeps.toml", SWEEPS))
    first = driver.wait_for_result()
    (before,) = first.concluded.traced.loop.effects
    assert (before.name, before.also_possible) == ("k_xxx", ("head_second_harmonic",))
    result = driver.window.result
    result.tabs.setCurrentWidget(result.loop)
    assert result.loop.experiments.item(0).text().startswith("probe-face-up-90")
    assert result.loop.run_button.isEnabled()

    monkeypatch.setattr("tumble.window.screens.result.load_programme", lambda name: load_programme(probes[name]))
    driver.press(Qt.Key.Key_F5)
    driver.wait(lambda: "What was measured so far is analysed first; then the experiment begins." in driver.log)
    assert driver.window.strip.state.text != "Ready"
    driver.wait(lambda: result.presentation is not first or driver.complaints, 120)

    assert driver.complaints == []
    effects = {effect.name: effect.also_possible for effect in result.presentation.concluded.traced.loop.effects}
    assert effects["k_xxx"] == ()
    before, probe = result.presentation.concluded.recordings
    assert before == first.concluded.recordings[0]
    assert read_recording(probe).complete
    used = len(result.presentation.concluded.traced.calibration.observations)
    assert used == len(read_recording(before).points) + len(read_recording(probe).points)
    assert_kept(driver, monkeypatch)


def assert_kept(driver, monkeypatch):
    """What both runs say together is a record like any other, with a report, and is opened with both."""
    shown = driver.window.result.presentation.concluded
    assert shown.report.is_file()
    driver.wait(lambda: shown.record_id in [record.id for record in driver.window.records.records])
    for name in ("fit", "trace"):  # it was analysed often enough
        monkeypatch.setattr(analysing, name, lambda *_, **__: None)
    assert open_record(driver.window.store, shown.record_id).recordings == shown.recordings
