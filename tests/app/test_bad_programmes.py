import pytest
from app_jobs import STAND, TINY, at_call, raiser, tumble

from tumble.drivers.simulated.head import SimulatedHead

FLIP = '[[procedure]]\nkind = "flip"\naxes = ["y"]\npole = "extremum"\n'
BAD = {
    "a bracket is missing": (
        TINY.replace("[[procedure]]", "[[procedure]"),
        "line 5: not TOML: Expected ']]' at the end of an array declaration; correct it",
    ),
    "an unknown procedure": (
        TINY.replace('"sweep"', '"spin"'),
        "line 5: procedure 1: Input tag 'spin' found using 'kind' does not match any of the expected tags: "
        "'flip', 'sweep'; correct it",
    ),
    "a negative duration": (TINY.replace("0.1", "-0.1"), "line 2: dwell_s: Input should be greater than 0; correct it"),
    "a negative number of points": (
        TINY.replace("= 6", "= -6"),
        "line 8: procedure 1 (sweep): points: Input should be greater than or equal to 1; correct it",
    ),
    "no step": (
        TINY.replace("step_deg = 60.0\n", ""),
        "line 5: procedure 1 (sweep): step_deg: Field required; add it",
    ),
    "an unknown mount": (
        TINY + 'mount = "side"\n',
        "line 9: procedure 1 (sweep): mount: 'side' is no mount; the mounts are face-up, face-up-90, face-down, edge, "
        "edge-back, end; correct it",
    ),
    "an extremum where there is none": (
        TINY + FLIP,
        'line 9: procedure 2 (flip): pole = "extremum" needs the x axis, the only one with an extremum at its poles; '
        "correct it",
    ),
    "limits the wrong way": (
        TINY + "[limits]\nkx = { min = 2.0, max = 1.0 }\n",
        "line 10: limits: kx: min = 2 is not below max = 1; correct it",
    ),
    "limits of nothing": (
        TINY + "[limits]\nk9 = { min = 1.0, max = 2.0 }\n",
        "line 10: limits: k9: Input should be 'u0', 'kx', 'ky', 'kz', 'kxy' or 'alpha0'; correct it",
    ),
}


def refused(programme, tmp_path, monkeypatch, *arguments):
    """What `tumble run` says of a programme; nothing may move, and no file may appear."""
    at_call(monkeypatch, SimulatedHead, "start_move", 1, raiser(AssertionError("the head moved")))
    ran = tumble("run", "--programme", programme, "--serial", "A", "--store", tmp_path / "store", *arguments)
    assert ran.status == 2
    assert not (tmp_path / "store").exists()
    return ran.complaint


@pytest.mark.parametrize(("text", "complaint"), BAD.values(), ids=BAD)
def test_a_bad_programme_is_named_with_line_and_remedy(write, tmp_path, monkeypatch, text, complaint):
    assert refused(write("mine.toml", text), tmp_path, monkeypatch) == f"mine.toml, {complaint}"


def test_an_unknown_programme_is_answered_with_those_that_come_along(tmp_path, monkeypatch):
    complaint = refused("sead", tmp_path, monkeypatch)

    assert complaint.startswith("sead: there is no such file; give a TOML file or one of probe-back, ")
    assert ", quick, reversal, seed, 0-120-240, " in complaint


def test_a_programme_beyond_the_limits_of_the_head_moves_nothing(write, tmp_path, monkeypatch):
    beyond = '[[procedure]]\nkind = "sweep"\nstart_deg = 500.0\nstep_deg = 100.0\npoints = 4\n'

    assert refused(write("mine.toml", TINY + beyond), tmp_path, monkeypatch) == (
        "mine.toml, line 9: the sweep goes to 800 deg, outside the head's limits of -180 to 760 deg; "
        "change the angles, or the limits of the stand"
    )


@pytest.mark.parametrize("command", ["calibrate", "plan"])
def test_limits_are_checked_before_anything_else_happens(write, tmp_path, command):
    stand = write("narrow.toml", STAND.replace("760.0", "90.0"))
    measure = (
        ("--programme", "seed", "--serial", "A", "--store", tmp_path / "s") if command == "calibrate" else ("seed",)
    )

    ran = tumble(command, *measure, "--stand", stand)

    assert ran.status == 2
    assert "the flip goes to 180 deg, outside the head's limits of -180 to 90 deg" in ran.complaint
    assert not (tmp_path / "s").exists()


def test_answers_that_are_none_are_named(write, tiny, tmp_path, monkeypatch):
    answers = write("answers.toml", '[mounts]\nface-up = "maybe"\n')

    complaint = refused(tiny, tmp_path, monkeypatch, "--answers", answers)

    assert complaint == "answers.toml, line 2: mounts: face-up: Input should be 'yes' or 'no'; correct it"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("run",), "Error: Missing option '--serial'."),
        (("plan",), "Error: Missing argument 'PROGRAMME'."),
        (("calibrat",), "Error: No such command 'calibrat'."),
        (("fit", "x.csv", "--fast"), "Error: No such option '--fast'."),
        (("records", "list", "--since", "noon"), "Error: Invalid value for '--since': 'noon' does not match"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else "",
)
def test_wrong_usage_is_status_2(arguments, message):
    ran = tumble(*arguments)

    assert ran.status == 2
    assert ran.err.splitlines()[-1].startswith(message[:-1])
