"""Headers of recordings that contradict themselves; those of older formats have no hash as a whole."""

from dataclasses import replace
from hashlib import sha256

import pytest
from recording_examples import HEADER

from tumble.app.header_checks import check_header
from tumble.app.stand import load_stand
from tumble.procedures.errors import InputError

BUILT_IN = load_stand()
OLD = replace(
    HEADER,
    format_version=2,
    programme_sha256=sha256(HEADER.programme_text.encode()).hexdigest(),
    stand=BUILT_IN.recorded,
    stand_sha256=BUILT_IN.sha256,
)
FLIPPED = {**BUILT_IN.recorded, "head": {**BUILT_IN.recorded["head"], "accuracy_arcsec": 1.0}}
"""One bit of the digit 5, as in the recording that was given with u(kx) 0.098 in place of 0.11."""


def test_a_header_that_agrees_with_itself_is_taken(tmp_path):
    check_header(tmp_path / "x.mcap", OLD)


def test_an_old_header_with_another_stand_than_its_hash_says_is_refused(tmp_path):
    with pytest.raises(
        InputError, match=r"x\.mcap: the stand in its header is not the one .* the recording was damaged"
    ):
        check_header(tmp_path / "x.mcap", replace(OLD, stand=FLIPPED))


def test_a_stand_that_is_given_takes_the_place_of_the_damaged_one(tmp_path):
    check_header(tmp_path / "x.mcap", replace(OLD, stand=FLIPPED), stand=BUILT_IN.recorded)


@pytest.mark.parametrize("version", [1, 2, 3])
def test_a_programme_that_is_not_the_one_of_its_hash_is_refused(tmp_path, version):
    with pytest.raises(InputError, match=r"the programme in its header is not the one that was run"):
        check_header(tmp_path / "x.mcap", replace(OLD, programme_text='name = "other"', format_version=version))
