import json

from app_jobs import tumble


def test_a_plan_says_what_is_measured_in_each_mounting():
    lines = tumble("plan", "quick").out.splitlines()

    assert lines[0] == "quick: 60 dwells between -90° and 330°, 6 mountings by hand, 0:09:00 in all"
    assert lines[1] == "  0:00:00  face-up: flip 1 at -90°, 90°, 180°, 0°; sweep 1, 12 settings, 0° to 330°"
    assert lines[2] == "  0:01:50  face-down: sweep 1, 12 settings, 330° to 0°"
    assert len(lines) == 1 + 6


def test_where_nothing_is_set_by_hand_a_plan_names_no_mounting():
    lines = tumble("plan", "6").out.splitlines()

    assert lines[1] == "  0:00:00  position 1, 6 settings, 90° to 180°, 0° to 180° and back"


def test_a_sweep_there_and_back_is_said_to_be_one():
    lines = tumble("plan", "reversal").out.splitlines()

    assert lines[2].endswith("edge: flip 1 at 180°, 0°; sweep 1, 159 settings, 0° to 395° and back")


def test_a_plan_shows_every_step_where_it_is_asked_to(tiny):
    summary, *lines = tumble("plan", tiny, "--steps").out.splitlines()

    assert summary == "tiny: 6 dwells between 0° and 300°, 1 mounting by hand, 0:01:16 in all"
    assert lines[0] == "    1  0:00:00  seat the unit in face-up (60 s allowed)"
    assert lines[1] == "    2  0:01:00  sweep 1: face-up at 0° (0.2 s)"
    assert lines[2] == "    3  0:01:00  sweep 1: face-up at 60° (3.2 s)"
    assert len(lines) == 7


def test_a_plan_as_json_counts_and_times_the_steps(tiny):
    document = json.loads(tumble("plan", tiny, "--json", "-").out)

    assert document["schema"] == "tumble.plan/1"
    assert (document["programme"], document["dwells"], document["mount_changes"]) == ("tiny", 6, 1)
    assert document["angle_range_deg"] == [0.0, 300.0]
    assert document["steps"][0] == {"step": "mounting", "mount": "face-up", "duration_s": 60.0}
    assert [step["angle_deg"] for step in document["steps"][1:]] == [0.0, 60.0, 120.0, 180.0, 240.0, 300.0]
    assert document["duration_s"] == sum(step["duration_s"] for step in document["steps"])


def test_the_published_programme_has_430_dwells():
    document = json.loads(tumble("plan", "seed", "--json", "-").out)

    assert document["dwells"] == 430


def test_a_plan_leaves_nothing_behind(tiny, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    assert tumble("plan", tiny).status == 0
    assert [path.name for path in tmp_path.iterdir()] == ["tiny.toml"]
