import io

import pytest
from app_jobs import tumble

from tumble.procedures.recording.reader import read_recording


@pytest.mark.parametrize(
    ("answers", "said", "points"),
    [
        ('face-up = "no"', "face-up was answered 'no'", 0),
        ('default = "yes"\nedge = "no"', "edge was answered 'no'", 28),
        ('face-up = "yes"', "face-down was not answered", 16),
        ("", "face-up was not answered", 0),
    ],
    ids=["no", "no to one mount", "a mount is missing", "nothing"],
)
def test_a_prompt_without_a_yes_ends_the_run_and_keeps_the_recording(write, tmp_path, answers, said, points):
    recording = tmp_path / "x.mcap"

    ran = tumble(
        "run", "--programme", "quick", "--serial", "A", "--out", recording,
        "--answers", write("answers.toml", f"[mounts]\n{answers}\n"),
    )  # fmt: skip

    assert ran.status == 2
    assert ran.complaint == (
        f"the request to seat the unit in {said}; seat it and resume the run; "
        f"{points} complete points kept in {recording}"
    )
    assert len(read_recording(recording).points) == points


@pytest.mark.parametrize(
    ("typed", "said"), [("no\n", "was answered 'no'"), ("", "was not answered")], ids=["no", "end of input"]
)
def test_an_attended_run_asks_on_standard_error_so_that_json_stays_alone(tiny, tmp_path, monkeypatch, typed, said):
    monkeypatch.setattr("sys.stdin", io.StringIO(typed))

    ran = tumble(
        "run", "--programme", tiny, "--serial", "A", "--out", tmp_path / "x.mcap", "--attended", "--json", "-"
    )  # fmt: skip

    prompt, complaint = ran.err.splitlines()
    assert ran.status == 2
    assert prompt == "Seat the unit in the mount face-up; answer face-up or yes when it sits there."
    assert said in complaint
    assert ran.out == ""
