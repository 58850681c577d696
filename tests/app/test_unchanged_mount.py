"""The unit is left as it sits although the operator confirms the next mount."""

from app_jobs import tumble

from tumble.drivers.simulated import SimulatedWorld

TWO_MOUNTS = """\
name = "two-mounts"
dwell_s = 0.1
settle_s = 0.0

[[procedure]]
kind = "sweep"
step_deg = 45.0
points = 8

[[procedure]]
kind = "sweep"
mount = "face-up-90"
step_deg = 45.0
points = 8
"""


def test_a_mount_that_was_not_changed_is_asked_about_in_a_sentence(write, tmp_path, monkeypatch):
    recording = tmp_path / "x.mcap"
    with monkeypatch.context() as asleep:
        asleep.setattr(SimulatedWorld, "seat", lambda *_: None)
        assert (
            tumble("run", "--programme", write("two.toml", TWO_MOUNTS), "--serial", "A", "--out", recording).status == 0
        )

    ran = tumble("fit", recording)

    assert ran.status == 0
    assert (
        "rows 9 to 16 are said to be in face-up-90 and fit face-up, where the unit sat before; was the unit seated as "
        "asked? Measure these rows again, or correct their mount"
    ) in " ".join(ran.err.split())


def test_a_mount_that_was_changed_is_not_asked_about(write, tmp_path):
    recording = tmp_path / "x.mcap"
    assert tumble("run", "--programme", write("two.toml", TWO_MOUNTS), "--serial", "A", "--out", recording).status == 0

    assert "seated as asked" not in tumble("fit", recording).err
