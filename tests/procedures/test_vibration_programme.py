"""Programmes of vibration: rest, vibration, rest, for lists of levels, frequencies, mountings, phases and rates."""

import pytest

from tumble.drivers.excitation import excitation_of
from tumble.drivers.mountings import Mounting, direction_of
from tumble.procedures.errors import InputError
from tumble.procedures.plan import nominal_point
from tumble.procedures.programmes import load_programme, programme_from_text
from tumble.procedures.steps import Ask

HEAD = 'method = "vibration"\nname = "p"\n\n[[procedure]]\n'


def programme(text):
    return programme_from_text(HEAD + text, "p.toml")


def conditions(made):
    """Of every dwell, and the requests between them."""
    steps, reply, procedure = [], None, made.procedure()
    while True:
        try:
            step = procedure.send(reply) if reply is not None else next(procedure)
        except StopIteration:
            return steps
        if isinstance(step, Ask):
            steps.append(f"{step.condition}: {step.value}")
            reply = object()
        else:
            steps.append(step.procedure)
            reply = nominal_point(made, step, 0)


def excitations(made):
    return [step.removeprefix("exciter: ") for step in conditions(made) if step.startswith("exciter: ")]


def test_every_excitation_is_between_two_rests_and_a_mounting_is_a_request():
    made = programme('levels_g = [2, 4]\nfrequencies_Hz = [80]\nmountings = [{}, { x = "o", y = "p" }]')
    one = ["exciter: rest", "rest", "exciter: sine 2 g 80 Hz", "vibration", "exciter: rest", "rest"]
    one += ["exciter: sine 4 g 80 Hz", "vibration", "exciter: rest", "rest"]
    first, second = "mount: x along i, y along o, p down", "mount: x along o, y along p, p down"
    assert conditions(made) == [first, *one, second, *one[1:]]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("sines = [[2, 40], [4, 80]]", ["sine 2 g 40 Hz", "sine 4 g 80 Hz"]),
        (
            'levels_g = [2, 4]\nfrequencies_Hz = [40]\norder = "there-and-back"',
            ["sine 2 g 40 Hz", "sine 4 g 40 Hz", "sine 4 g 40 Hz", "sine 2 g 40 Hz"],
        ),
        (
            'kind = "random"\npsd = [[20, 0.01], [120, 0.01]]\nlevels_g = [1, 2]',
            ["random 20 Hz 0.01, 120 Hz 0.01", "random 20 Hz 0.04, 120 Hz 0.04"],
        ),
        (
            'kind = "shakers"\nlevels_g = { x = 3, y = 4 }\nfrequencies_Hz = { x = 40, y = 40 }\n'
            "phases_deg = [{}, { y = 90 }]",
            ["sine x 3 g 40 Hz 0 deg, y 4 g 40 Hz 0 deg", "sine x 3 g 40 Hz 0 deg, y 4 g 40 Hz 90 deg"],
        ),
        (
            'kind = "centrifuge"\nmain_rad_s = [10]\nfrequencies_Hz = [1, -2]',
            ["rotation 10 6.28318531", "rotation 10 -12.5663706"],
        ),
    ],
)
def test_what_each_kind_excites(text, expected):
    assert [each for each in excitations(programme(text)) if each != "rest"] == expected


def test_a_shuffled_order_is_another_in_each_mounting_and_the_same_each_time():
    text = 'sines = [[1, 40], [2, 40], [3, 40], [4, 40], [5, 40]]\norder = "shuffled"\nmountings = [{}, {}]'
    text = text.replace("{}, {}", '{}, { x = "o", y = "p" }')
    orders = [each for each in excitations(programme(text)) if each != "rest"]
    assert orders == [each for each in excitations(programme(text)) if each != "rest"]
    assert orders[:5] != orders[5:] and sorted(orders[:5]) == sorted(orders[5:])


@pytest.mark.parametrize(
    ("text", "mistake"),
    [
        ("levels_g = [2]", "give levels_g and frequencies_Hz, or sines, and not both"),
        ('kind = "random"', "name one profile, or give psd, and not both"),
        ('kind = "random"\nprofile = "moon"', "no profile is called 'moon'"),
        ('kind = "random"\npsd = [[20, 0.01], [10, 0.01]]', "with rising frequencies"),
        ('sines = [[2, 40]]\nmountings = [{ x = "i", y = "i+o" }]', "are not square to each other"),
        ('sines = [[2, 40]]\nmountings = [{ x = "q" }]', "'q' is no direction in the unit"),
        ('kind = "shakers"\nlevels_g = { x = 3 }\nfrequencies_Hz = { y = 40 }', "name different shakers"),
    ],
)
def test_a_mistake_is_told_with_its_line(text, mistake):
    with pytest.raises(InputError, match=mistake) as error:
        programme(text)
    assert str(error.value).startswith("p.toml, line ")


@pytest.mark.parametrize("text", ["rest", "sine 5 g 80 Hz", "rotation 10 -20", "random 20 Hz 0.001, 2000 Hz 0.001"])
def test_an_excitation_is_its_text(text):
    assert excitation_of(text).text == text


@pytest.mark.parametrize("text", ["", "sine", "sine 5 g", "random 20 Hz 0.001", "rotation 10", "shake"])
def test_what_is_no_excitation_is_told(text):
    with pytest.raises(ValueError, match="is no excitation, such as rest"):
        excitation_of(text)


def test_a_density_has_the_root_of_its_area():
    assert excitation_of("random 10 Hz 0.015, 40 Hz 0.015, 500 Hz 0.00015").rms_g == pytest.approx(1.04, abs=0.005)


def test_a_direction_is_a_unit_vector_and_the_table_is_right_handed():
    assert direction_of("i+o") == pytest.approx((0.5**0.5, 0.5**0.5, 0.0))
    assert direction_of("0.8i-0.6p") == pytest.approx((0.8, 0.0, -0.6))
    assert Mounting.of("x along i, y along o, p down").table[2] == pytest.approx((0.0, 0.0, 1.0))


@pytest.mark.parametrize("name", ["vibration", "vibration-fixtures", "vibration-centrifuge", "vibration-phases"])
def test_what_comes_along_can_be_read(name):
    assert load_programme(name).name == name
