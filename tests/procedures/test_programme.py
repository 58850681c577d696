from hashlib import sha256
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tumble.procedures.errors import ProgrammeError
from tumble.procedures.programmes import load_programme, programme_from_text, shipped_programmes
from tumble.procedures.steps import Ask, Dwell

PROBES = [
    "probe-back",
    "probe-edge",
    "probe-edge-back",
    "probe-end",
    "probe-face-down",
    "probe-face-up-90",
    "probe-later",
    "probe-repeat",
    "probe-shuffled",
    "probe-slow",
    "probe-turns",
    "probe-warm",
]

SWEEP = """\
name = "sweeps-only"
realisations = 3
dwell_s = 0.5

[[procedure]]
kind = "sweep"
mount = "face-up"
step_deg = 5.0
points = 80

[limits]
kx = { min = 0.95, max = 1.05 }
"""


def read(text):
    return programme_from_text(text, "mine.toml")


def complaint(text):
    with pytest.raises(ProgrammeError) as raised:
        read(text)
    return str(raised.value)


GYROCOMPASSES = ["0-120-240", "0-180-90-270", "0-90-180", "0-90-180-270", "0-90-180-90-0"]
GYROCOMPASSES += ["another-lean", "every-30", "two-bases"]
TRIADS = ["12", "12o", "16o", "18", "18-there-and-back", "24", "24-there-and-back", "24f", "6", "8o", "fine"]
VIBRATIONS = [
    "vibration",
    *(f"vibration-{each}" for each in ("centrifuge", "fixtures", "frequencies", "input-axis", "phases", "random")),
    *(f"vibration-{each}" for each in ("reversed", "three-shakers", "turned", "up-and-down")),
]


def test_programmes_that_come_along():
    assert shipped_programmes()[: len(PROBES) + 3] == [*PROBES, "quick", "reversal", "seed"]
    assert shipped_programmes()[len(PROBES) + 3 :] == [*GYROCOMPASSES, *TRIADS, *VIBRATIONS]


@pytest.mark.parametrize("name", [*PROBES, "quick", "reversal", "seed"])
def test_a_programme_that_comes_along_bears_its_own_name(name):
    assert load_programme(name).name == name


def test_a_programme_keeps_its_text_and_its_sum(tmp_path: Path):
    path = tmp_path / "mine.toml"
    path.write_bytes(SWEEP.replace("\n", "\r\n").encode())
    programme = load_programme(path)
    assert programme.text == SWEEP.replace("\n", "\r\n")
    assert programme.sha256 == sha256(path.read_bytes()).hexdigest()


def test_limits_are_intervals_by_parameter():
    limit = read(SWEEP).limits["kx"]
    assert (limit.min, limit.max) == (0.95, 1.05)


def test_an_unknown_programme_is_answered_with_those_that_exist():
    with pytest.raises(ProgrammeError, match=r"^sed: there is no such file; .* quick, reversal, seed, 0-120-240, "):
        load_programme("sed")


def test_a_file_in_another_encoding_is_no_programme(tmp_path: Path):
    path = tmp_path / "mine.toml"
    path.write_bytes(b'name = "\xff"')
    with pytest.raises(ProgrammeError, match="not UTF-8"):
        load_programme(path)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "step_deg = 5.0",
            'step_deg = "five"',
            "mine.toml, line 8: procedure 1 (sweep): step_deg: Input should be a valid number, unable to parse string "
            "as a number; correct it",
        ),
        ("step_deg = 5.0\n", "", "mine.toml, line 5: procedure 1 (sweep): step_deg: Field required; add it"),
        (
            "face-up",
            "upside",
            "mine.toml, line 7: procedure 1 (sweep): mount: 'upside' is no mount; the mounts are face-up, face-up-90, "
            "face-down, edge, edge-back, end; correct it",
        ),
        (
            'kind = "sweep"',
            'kind = "swap"',
            "mine.toml, line 5: procedure 1: Input tag 'swap' found using 'kind' does not match any of the expected "
            "tags: 'flip', 'sweep'; correct it",
        ),
        ("max = 1.05", "max = 0.9", "mine.toml, line 12: limits: kx: min = 0.95 is not below max = 0.9; correct it"),
        (
            "kx =",
            "k =",
            "mine.toml, line 12: limits: k: Input should be 'u0', 'kx', 'ky', 'kz', 'kxy' or 'alpha0'; correct it",
        ),
        (
            "realisations",
            "repeats",
            "mine.toml, line 2: repeats: Extra inputs are not permitted; correct its spelling or take it out",
        ),
    ],
)
def test_a_fault_is_named_with_its_line(old, new, message):
    assert complaint(SWEEP.replace(old, new)) == message


@pytest.mark.parametrize(
    ("flip", "message"),
    [
        ('axes = ["x", "x"]', "mine.toml, line 4: procedure 1 (flip): axes: an axis is named twice; correct it"),
        (
            'axes = ["y"]\npole = "extremum"',
            'mine.toml, line 2: procedure 1 (flip): pole = "extremum" needs the x axis, the only one with an extremum '
            "at its poles; correct it",
        ),
    ],
)
def test_a_flip_that_makes_no_sense_is_refused(flip, message):
    assert complaint(f'name = "a"\n[[procedure]]\nkind = "flip"\n{flip}\n') == message


@pytest.mark.parametrize(
    ("said", "samples"),
    [
        ("", 77),
        ("dwell_s = 0.5", 500),
        ("samples = 12", 12),
        ("dwell_s = 0.5\nsamples = 12", 12),
        ("dwell_s = 1e-9", 2),
    ],
)
def test_samples_come_from_the_programme_or_else_from_the_stand(said, samples):
    text = SWEEP.replace("dwell_s = 0.5", said)
    assert read(text).acquisition(samples=77, rate_hz=1000.0).samples == samples


@pytest.mark.parametrize(
    ("said", "block"), [("samples = 400", 40), ("samples = 20", 5), ("samples = 400\nsettle_samples = 7", 7)]
)
def test_a_settling_block_is_a_tenth_of_a_dwell_unless_told_otherwise(said, block):
    text = SWEEP.replace("dwell_s = 0.5", said)
    assert read(text).acquisition(samples=77, rate_hz=1000.0).settle_samples == block


def steps_of(text, reply):
    procedure = read(text).procedure()
    step = next(procedure, None)
    while step is not None:
        yield step
        try:
            step = procedure.send(reply(step))
        except StopIteration:
            step = None


PARTS = {
    "a": '[[procedure]]\nkind = "flip"\naxes = ["x", "z"]\n',
    "b": '[[procedure]]\nkind = "sweep"\nmount = "edge"\nstep_deg = 90\npoints = 2\n',
    "c": '[[procedure]]\nkind = "sweep"\nmount = "face-up"\nstep_deg = 90\npoints = 2\norder = "shuffled"\nseed = 3\n',
}


@given(order=st.lists(st.sampled_from("abc"), min_size=1, max_size=4), realisations=st.integers(1, 3))
def test_the_unit_is_seated_exactly_where_the_mount_changes(order, realisations, nominal_reply):
    text = f'name = "a"\nrealisations = {realisations}\n' + "".join(PARTS[part] for part in order)
    seated = None
    for step in steps_of(text, nominal_reply):
        if isinstance(step, Ask):
            assert step.value != seated
            seated = step.value
        else:
            assert step.conditions == {"mount": seated}


def test_realisations_are_numbered_from_1(nominal_reply):
    dwells = [step for step in steps_of(SWEEP, nominal_reply) if isinstance(step, Dwell)]
    assert [dwell.realisation for dwell in dwells] == [1] * 80 + [2] * 80 + [3] * 80
