from pathlib import Path

import pytest
from pydantic import BaseModel, ConfigDict

from tumble.procedures.errors import InputError
from tumble.procedures.toml_lines import line_of, load_toml, parse_toml

TEXT = """\
name = "bench"

[head]
driver = "zaber"
serial.port = "COM3"

[[procedure]]
kind = "flip"

[[procedure]]
kind = "sweep"
"step_deg" = 5

[limits]
kx = { min = 1, max = 2 }
"""


class Head(BaseModel):
    model_config = ConfigDict(extra="forbid")
    url: str
    speed_deg_s: float = 1.0


class Bench(BaseModel):
    head: Head


@pytest.mark.parametrize(
    ("location", "line"),
    [
        (("name",), 1),
        (("head",), 3),
        (("head", "driver"), 4),
        (("head", "serial", "port"), 5),
        (("procedure", 0, "kind"), 8),
        (("procedure", 1), 10),
        (("procedure", 1, "sweep", "step_deg"), 12),
        (("procedure", 1, "sweep", "points"), 10),
        (("limits", "kx", "min"), 15),
        (("nowhere",), None),
    ],
)
def test_the_line_of_a_value_is_found(location, line):
    assert line_of(TEXT, location) == line


def test_a_file_that_fits_becomes_a_model(tmp_path: Path):
    path = tmp_path / "bench.toml"
    path.write_text('[head]\nurl = "COM3"\n', encoding="utf-8")
    assert load_toml(path, Bench) == Bench(head=Head(url="COM3"))


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("[head]\n", "bench.toml, line 1: head: url: Field required; add it"),
        (
            '[head]\nurl = "a"\nsped_deg_s = 2\n',
            "bench.toml, line 3: head: sped_deg_s: Extra inputs are not permitted; correct its spelling or take it out",
        ),
        (
            '[head]\nspeed_deg_s = "fast"\n',
            "bench.toml, line 1: head: url: Field required; add it (and 1 more)",
        ),
        ("[head]\nurl = COM3\n", "bench.toml, line 2: not TOML: Invalid value; correct it"),
        ("", "bench.toml: head: Field required; add it"),
        ("head = 3\n", "bench.toml, line 1: head: Input should be a valid dictionary or instance of Head; correct it"),
    ],
)
def test_a_complaint_names_file_line_key_and_remedy(text, complaint):
    with pytest.raises(InputError) as raised:
        parse_toml(text, Bench, "bench.toml")
    assert str(raised.value) == complaint


def test_a_text_that_ends_too_early_is_no_toml():
    with pytest.raises(InputError, match=r"^bench\.toml.*: not TOML: "):
        parse_toml('[head]\nurl = """', Bench, "bench.toml")


def test_a_file_that_cannot_be_read_is_named(tmp_path: Path):
    with pytest.raises(InputError, match=r"absent\.toml: .*; give a file that can be read"):
        load_toml(tmp_path / "absent.toml", Bench)


def test_a_file_in_another_encoding_is_named(tmp_path: Path):
    path = tmp_path / "bench.toml"
    path.write_bytes('url = "Стенд"'.encode("cp1251"))
    with pytest.raises(InputError, match=r"bench\.toml: byte 7 is not UTF-8; save the file as UTF-8"):
        load_toml(path, Bench)
